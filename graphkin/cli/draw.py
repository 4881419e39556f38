"""``graphkin draw``: figures, readings and the check."""

from __future__ import annotations

from graphkin.cli.check import print_check, unchecked
from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FindOption,
    FormatOption,
    InstrumentOption,
    JsonOption,
    OutOption,
    QuietOption,
    SceneArgument,
    SeedOption,
    SheetLangOption,
    driver_values,
    listed,
)
from graphkin.cli.output import print_paths, unsolvable_as_json
from graphkin.words import languages

__all__ = ["draw"]


def draw(
    scene: SceneArgument,
    out: OutOption = None,
    formats: FormatOption = "svg",
    at: AtOption = None,
    find: FindOption = None,
    lang: SheetLangOption = None,
    convention: ConventionOption = None,
    instrument: InstrumentOption = "exact",
    seed: SeedOption = 0,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Draw the mechanism, the velocity and the acceleration polygon; measure and check them."""
    from graphkin.api import draw as drawing

    wanted = listed(formats)
    with unsolvable_as_json(as_json, unchecked):
        drawn = drawing(scene, None, driver_values(at), find or None, wanted, lang, convention, instrument, seed)
        paths = drawn.write(out, wanted)
    if not as_json and not quiet:
        print_paths(paths)
    print_check(drawn.checked, languages(lang or drawn.checked.scene.sheet.language)[0], as_json, quiet)
