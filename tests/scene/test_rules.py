"""Each rule of the scene format that can be broken gives a sentence that names the thing and what would be right."""

from __future__ import annotations

import math

import pytest

import graphkin
from graphkin.errors import SceneError
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.scene.tables import value_at

from .scenes import FOUR_BAR, SIX_BAR, changed

pytestmark = pytest.mark.quick

LINK1 = 'length = 150'
LINK2 = 'length = 500'
DRIVER = 'link = "1"\nangle = 60\nomega = 10'
E_AT = "E = [100, 50]"
GUIDE_S = 's = { through = "E", angle = 90 }'

BROKEN = {
    # keys, tables, numbers
    "unknown key": ((LINK1, "lenght = 150"), ["links.1.lenght", 'did you mean "length"']),
    "unknown table": (("[driver]", "[drivers]"), ["drivers", "unknown table", 'did you mean "driver"']),
    "unknown unit": (("[frame]", '[units]\nlength = "mn"\n[frame]'), ["units.length", '"mn"', '"mm"']),
    "unknown key of units": (("[frame]", '[units]\ntime = "h"\n[frame]'), ["units.time", "length"]),
    "top key in a table": (("omega = 10", 'omega = 10\nfind = ["v_B"]'), ["driver.find", "top of the file"]),
    "infinite": ((LINK1, "length = inf"), ["links.1.length", "inf", "a finite number is wanted"]),
    "overflow": ((LINK1, "length = 1e400"), ["links.1.length", "inf", "finite"]),
    "not a number": (("omega = 10", "omega = nan"), ["driver.omega", "nan", "finite"]),
    "huge": (("omega = 10", "omega = 1e20"), ["driver.omega", "1e+20", "1e+15"]),
    "huge integer": ((LINK1, "length = 1" + "0" * 400), ["links.1.length", "finite"]),
    "zero length": ((LINK1, "length = 0"), ["links.1.length", "0", "zero", "positive"]),
    "tiny length": ((LINK1, "length = 1e-16"), ["links.1.length", "1e-16", "far too small", "positive"]),
    "negative length": ((LINK1, "length = -5"), ["links.1.length", "-5", "negative", "positive"]),
    "negative radius": ((E_AT, 'E = { from = "B", r = -5 }'), ["links.2.at.E.r", "-5", "positive"]),
    "number for a truth": (("[frame]", "[sheet]\nloops = 1\n[frame]"), ["sheet.loops", "1", "true or false is wanted"]),
    "word for a truth": (("[frame]", '[vary]\nonly = "on"\n[frame]'), ["vary.only", '"on"', "true or false is wanted"]),
    "number for a list": (("[frame]", "[positions]\nmarks = 3\n[frame]"), ["positions.marks", "a list is wanted"]),
    "zero tolerance": (("[frame]", "[vary]\ntolerance = 0\n[frame]"), ["vary.tolerance", "a number must be positive"]),
    "truth for a number": ((LINK1, "length = true"), ["links.1.length", "true", "a number"]),
    "text for a number": ((LINK1, 'length = "150"'), ["links.1.length", '"150"', "without quotation marks"]),
    "date for a number": ((LINK1, "length = 2020-01-01"), ["links.1.length", "2020-01-01", "number"]),
    "number for a name": (('link = "1"', "link = 1"), ["driver.link", 'quotation marks: "1"']),
    "number for a title": (('title = "Four-bar"', "title = 4"), ["title", "quotation marks"]),
    "long title": (('title = "Four-bar"', f'title = "{"x" * 301}"'), ["title", "301", "300"]),
    "control character": (('"Four-bar"', '"Four\\u0007bar"'), ["title", "control character"]),
    "place of three": (("D = [400, 0]", "D = [400, 0, 1]"), ["frame.points.D", "[400, 0, 1]", "[x, y]"]),
    "place of one": ((E_AT, "E = [100]"), ["links.2.at.E", "[100]", "[x, y]"]),
    "point name": (('points = ["B", "C"]', 'points = ["b", "C"]'), ["links.2.points", '"b"', "capital letter"]),
    "link name": (("[links.3]", '[links."a b"]'), ['"a b"', "letters and digits"]),
    "guide name": ((GUIDE_S, f'"s-1" = {GUIDE_S[4:]}'), ["s-1", "letters and digits"]),
    "no links": ((FOUR_BAR, "title = 'x'"), ["links", "missing", "[links.1]"]),
    "empty links": ((FOUR_BAR, "[links]"), ["links", "none", "[links.1]"]),
    "link no table": ((FOUR_BAR, "[links]\n1 = 3"), ["links.1", "3", "a table is wanted"]),
    "sheet paper": (("[frame]", '[sheet]\npaper = "A9"\n[frame]'), ["sheet.paper", '"A9"', '"A4"']),
    "sheet convention": (
        ("[frame]", '[sheet]\nconvention = "rusian"\n[frame]'), ["sheet.convention", 'did you mean "russian"?']),
    "sheet scale": (("[frame]", "[sheet]\nlength_scale = 0\n[frame]"), ["sheet.length_scale", "positive"]),
    # own points
    "three names": (('["B", "C"]', '["B", "C", "E"]'), ["links.2.points", "3 names", "at"]),
    "point twice": (('["B", "C"]', '["B", "B"]'), ["links.2.points", "B", "twice", "different"]),
    "length of one point": (('points = ["B", "C"]', 'points = ["B"]'), ["links.2.length", "500", "two names"]),
    "no length": (("length = 500\n", ""), ["links.2.length", "missing", "B and C", "[drawn]"]),
    "nothing placed": (
        ("[driver]", "[links.9]\n[driver]"), ["links.9", "neither points nor on", "write points"]),
    "no direction": ((GUIDE_S, 's = { through = "E" }'), ["links.2.guides.s", "no direction", "angle"]),
    "frame's name": (('name = "4"', 'name = "3"'), ["frame.name", '"3"', "moving link"]),
    # further points
    "from nowhere": ((E_AT, 'E = { from = "Q", r = 5 }'), ["links.2.at.E.from", "Q", "nowhere placed", "B, C, E"]),
    "toward nowhere": (
        (E_AT, 'E = { from = "B", r = 5, toward = "D" }'), ["links.2.at.E.toward", "D", "nowhere placed"]),
    "toward itself": (
        (E_AT, 'E = { from = "B", r = 5, toward = "B" }'), ["links.2.at.E.toward", "B itself", "elsewhere"]),
    "no radius": ((E_AT, 'E = { from = "B" }'), ["links.2.at.E.r", "missing", "distance"]),
    "unknown form": ((E_AT, "E = true"), ["links.2.at.E", "true", "[x, y]", "from"]),
    "unknown key of polar": ((E_AT, 'E = { from = "B", r = 5, angel = 3 }'), ["links.2.at.E.angel", '"angle"']),
    "no such word": ((E_AT, 'E = "drwn"'), ["links.2.at.E", '"drwn"', '"drawn"']),
    "circle": (
        (E_AT, 'E = { from = "F", r = 5 }, F = { from = "E", r = 5 }'), ["links.2.at", "E, F", "one another"]),
    "arcs apart": (
        (E_AT, 'E = { from = ["B", "C"], r = [60, 80], side = "left" }'),
        ["links.2.at.E", "60 about B", "80 about C", "do not meet", "BC = 500", "440", "560"]),
    "arcs about one": (
        (E_AT, 'E = { from = ["B", "B"], r = [60, 80], side = "left" }'),
        ["links.2.at.E.from", "B and B", "same place"]),
    "side missing": ((E_AT, 'E = { from = ["B", "C"], r = [400, 300] }'), ["links.2.at.E.side", "missing"]),
    "side unknown": (
        (E_AT, 'E = { from = ["B", "C"], r = [400, 300], side = "up" }'), ["links.2.at.E.side", '"up"', '"left"']),
    "one radius": (
        (E_AT, 'E = { from = ["B", "C"], r = [400], side = "left" }'), ["links.2.at.E.r", "two lengths"]),
    "placed twice": (
        (E_AT, "E = [100, 50], C = [400, 0]"), ["links.2.at.C", "[400, 0]", "[500, 0]", "leave one"]),
    "drawn nowhere": ((E_AT, 'E = "drawn"'), ["links.2.at.E", "not in [drawn]", "E = [x, y]"]),
    "through nowhere": ((GUIDE_S, 's = { through = "Q", angle = 1 }'), ["links.2.guides.s.through", "Q", "B, C, E"]),
    "toward unknown": ((GUIDE_S, 's = { through = "E", toward = "Q" }'), ["links.2.guides.s.toward", "Q", "[drawn]"]),
    "toward own place": (
        (GUIDE_S, 's = { through = "E", toward = "E" }'), ["links.2.guides.s.toward", "E", "elsewhere"]),
    "angle against toward": (
        (GUIDE_S, 's = { through = "B", toward = "C", angle = 3 }'), ["links.2.guides.s.angle", "3 deg", "0 deg"]),
    "too many on a link": (
        (E_AT, ", ".join(f"P{i} = [{i}, 0]" for i in range(101))), ["links.2", "too many", "100"]),
    # sliding pairs
    "no such link": (("[driver]", '[links.9]\npoints = ["C"]\non = "7"\n[driver]'), ["links.9.on", '"7"', "1, 2, 3"]),
    "no such guide": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = "4.h"\n[driver]'), ["links.9.on", "4", '"h"', "g"]),
    "guide of a link without": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = "3.h"\n[driver]'), ["links.9.on", '"h"', 'own axis', '"3"']),
    "on itself": (("[driver]", '[links.9]\npoints = ["C"]\non = "9"\n[driver]'), ["links.9.on", "itself"]),
    "twice on a link": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = ["4", "4.g"]\n[driver]'), ["links.9.on", "already", "4"]),
    "each on the other": (
        ("[driver]", '[links.8]\non = "9"\n[links.9]\npoints = ["C"]\non = "8"\n[driver]'), ["links.9.on", "already"]),
    "pinned and sliding": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = "3"\n[driver]'), ["links.9.on", "C", "link 3", "pins"]),
    "three guides": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = ["1", "4", "4.g"]\n[driver]'),
        ["links.9.on", "one guide or two"]),
    "guide of a guide": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = "4.g.h"\n[driver]'), ["links.9.on", "4.g.h", "LINK.GUIDE"]),
    "on is a number": (("[driver]", '[links.9]\npoints = ["C"]\non = 4\n[driver]'), ["links.9.on", "4", '"LINK"']),
    "angle_on alone": ((LINK2, "length = 500\nangle_on = 3"), ["links.2.angle_on", "without on"]),
    "angle_on count": (
        ("[driver]", '[links.9]\npoints = ["C"]\non = ["4", "1"]\nangle_on = 90\n[driver]'),
        ["links.9.angle_on", "numbers found: 1, guides: 2", "one number for each"]),
    "held by nothing": (
        ("[driver]", '[links.9]\npoints = ["X", "Y"]\nlength = 5\n[driver]'), ["links.9", "nothing holds"]),
    "held by one another only": (
        ("[driver]", '[links.8]\npoints = ["X"]\n[links.9]\npoints = ["X", "Y"]\nlength = 5\n[driver]'),
        ["links 8, 9", "to the frame", "link 4"]),
    # pins in slots
    "pin of no link": (("[driver]", '[pins.B]\nof = "9"\nin = "4.g"\n[driver]'), ["pins.B.of", '"9"', "1, 2, 3"]),
    "pin of another link": (
        ("[driver]", '[pins.E]\nof = "3"\nin = "4.g"\n[driver]'), ["pins.E.of", "E", "link 3", "C, D"]),
    "pin in no slot": (("[driver]", '[pins.E]\nof = "2"\nin = "4.s"\n[driver]'), ["pins.E.in", '"s"']),
    "pin in its own link": (("[driver]", '[pins.E]\nof = "2"\nin = "2.s"\n[driver]'), ["pins.E.in", "itself"]),
    "pin twice in a link": (
        ("[driver]", '[pins.E]\nof = "2"\nin = ["4", "4.g"]\n[driver]'), ["pins.E.in", "twice", "4"]),
    "pin that is a joint": (("[driver]", '[pins.C]\nof = "2"\nin = "3"\n[driver]'), ["pins.C.in", "turning pair"]),
    "pin without slot": (("[driver]", '[pins.E]\nof = "2"\n[driver]'), ["pins.E.in", "missing"]),
    # drivers
    "driver of nothing": (('link = "1"\n', ""), ["driver.link", "missing", "slide"]),
    "driver of both": ((DRIVER, DRIVER + '\nslide = "2"'), ["driver.slide", "either link"]),
    "driver of no link": (('link = "1"', 'link = "7"'), ["driver.link", '"7"', "known here: 1, 2, 3"]),
    "driver of the frame": (('link = "1"', 'link = "4"'), ["driver.link", "frame", "1, 2, 3"]),
    "relative to no link": ((DRIVER, DRIVER + '\nrelative_to = "8"'), ["driver.relative_to", '"8"']),
    "relative to itself": ((DRIVER, DRIVER + '\nrelative_to = "1"'), ["driver.relative_to", "itself"]),
    "omega and rpm": ((DRIVER, DRIVER + "\nrpm = 95"), ["driver.omega", "omega = 10", "rpm = 95", "one of the two"]),
    "no omega": (("omega = 10\n", ""), ["driver.omega", "missing", "rpm"]),
    "no angle": (("angle = 60\n", ""), ["driver.angle", "missing", "degrees", "[drawn]"]),
    "driven twice": (
        (f"[driver]\n{DRIVER}", f"[[driver]]\n{DRIVER}\n[[driver]]\n{DRIVER}"), ["driver.2", "1", "already"]),
    "driven from another link and from the frame": (
        (f"[driver]\n{DRIVER}", f'[[driver]]\n{DRIVER}\nrelative_to = "2"\n[[driver]]\n{DRIVER}'),
        ["driver.2", "1", "already", 'write the first as link = "2", relative_to = "1"']),
    "driven from the frame and from another link": (
        (f"[driver]\n{DRIVER}", f'[[driver]]\n{DRIVER}\n[[driver]]\n{DRIVER}\nrelative_to = "2"'),
        ["driver.2", "1", "already", 'write the second as link = "2", relative_to = "1"']),
    "driven from both sides": (
        (f"[driver]\n{DRIVER}",
         f'[[driver]]\n{DRIVER}\nrelative_to = "2"\n[[driver]]\nlink = "2"\nangle = 1\nomega = 1\nrelative_to = "1"'),
        ["driver.2", "between links 2 and 1", "already"]),
    "redundant driver": ((LINK1, "length = 150\nredundant = true"), ["driver.link", "redundant"]),
    "slide of no link": (
        (DRIVER, 'slide = "7"\ntravel = 1\nvelocity = 1'), ["driver.slide", '"7"', "there is none here"]),
    "slide of a bar": ((DRIVER, 'slide = "2"\ntravel = 1\nvelocity = 1'), ["driver.slide", "slides on nothing"]),
    # questions
    "sketch of nothing": (("[driver]", "[sketch]\nQ = [1, 2]\n[driver]"), ["sketch.Q", "Q", "A, B, C, D, E"]),
    "drawing of nothing": (("[driver]", "[drawn]\nQ = [1, 2]\n[driver]"), ["drawn.Q", "Q", "A, B, C, D, E"]),
    "find is a text": (('title = "Four-bar"', 'find = "v_B"'), ["find", '"v_B"', "list"]),
    "find of no point": (('title = "Four-bar"', 'find = ["v_Q"]'), ["find", "Q", "A, B, C, D, E"]),
    "find of no link": (('title = "Four-bar"', 'find = ["omega_9"]'), ["find", '"9"', "1, 2, 3, 4"]),
    "find under no link": (('title = "Four-bar"', 'find = ["v_B@9"]'), ["find", '"9"', "1, 2, 3, 4"]),
    "find of no quantity": (('title = "Four-bar"', 'find = ["speed"]'), ["find", '"speed"', "v_B"]),
    "find of itself": (('title = "Four-bar"', 'find = ["v_B/B"]'), ["find", "itself"]),
    "Coriolis of two points": (('title = "Four-bar"', 'find = ["ak_B@1/C@2"]'), ["find", "two different points"]),
    "printed of no point": (("[driver]", "[printed]\nv_Q = 3\n[driver]"), ["printed.v_Q", "Q"]),
    "printed rate of two": (("[driver]", "[printed]\nomega_2 = [1, 2]\n[driver]"), ["printed.omega_2", "one number"]),
    "printed list": (("[driver]", "[printed]\nv_B = [1, 2, 3]\n[driver]"), ["printed.v_B", "[1, 2, 3]", "as printed"]),
    "printed text": (("[driver]", "[printed]\nv_B = 'x'\n[driver]"), ["printed.v_B", '"x"', "as printed"]),
}


def messages(text: str) -> list[str]:
    with pytest.raises(SceneError) as error:
        mechanism_of_text(text, "test")
    return [str(p) for p in error.value.problems]


@pytest.mark.parametrize("rule", BROKEN)
def test_a_broken_rule_gives_one_sentence_that_names_the_thing(rule: str) -> None:
    change, fragments = BROKEN[rule]
    text = FOUR_BAR.replace(*change, 1)
    assert text != FOUR_BAR
    [sentence] = messages(text)
    missing = [f for f in fragments if f not in sentence]
    assert missing == [], sentence


def test_a_slide_that_is_ambiguous_lists_its_pairs() -> None:
    text = changed(SIX_BAR, ('on     = "6.h"', 'on     = ["6.h", "1"]'),
                   ('link  = "1"\nangle = 50\nomega = -10', 'slide = "5"\ntravel = 3\nvelocity = 1'))
    [sentence] = messages(text)
    assert '"5/6" or "5/1"' in sentence


def test_a_driven_slide_without_velocity_asks_for_it() -> None:
    text = changed(SIX_BAR, ('link  = "1"\nangle = 50\nomega = -10', 'slide = "5"\ntravel = 3'))
    [sentence] = messages(text)
    assert sentence.startswith("driver.velocity: is missing")


def test_a_driven_slide_has_no_omega() -> None:
    text = changed(SIX_BAR, ('link  = "1"\nangle = 50', 'slide = "5"\ntravel = 3\nvelocity = 1'))
    assert messages(text) == [
        "driver.omega: unknown key; known here: acceleration, from, law, near, relative_to, slide, time, travel, "
        "velocity"]


def test_a_redundant_link_does_not_drive_by_its_slide() -> None:
    text = changed(SIX_BAR, ('link  = "1"\nangle = 50\nomega = -10', 'slide = "5"\ntravel = 3\nvelocity = 1'),
                   ('on     = "6.h"', 'on     = "6.h"\nredundant = true'))
    assert messages(text) == ["driver.slide: link 5 is redundant; drive by a link that counts"]


def test_a_pin_and_a_sliding_pair_do_not_share_their_name() -> None:
    text = changed(SIX_BAR, ("[links.4]", "[links.D]"), ("[driver]", '[pins.D]\nof = "5"\nin = "3"\n[driver]'))
    [sentence] = messages(text)
    assert "D/3 is also the name of a sliding pair; rename link D" in sentence


def test_a_driven_pin_may_bear_the_name_of_a_link_that_slides_elsewhere() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -50], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40, "guides": {"s": {"through": [0, 10], "angle": 0}}},
            "2": {"points": ["E", "D"], "length": 130},
            "D": {"points": ["E"], "on": "0.h"},
        },
        "pins": {"D": {"of": "2", "in": "1.s"}},
        "driver": [{"link": "1", "angle": 50, "omega": 3}, {"slide": "D/1", "travel": 70, "velocity": 20}],
        "sketch": {"D": [40, 60], "E": [90, -50]},
    }
    assert ["1", "D/1"] == [driver.key for driver in mechanism_of(scene).drivers]


def test_a_long_name_is_refused() -> None:
    [sentence] = messages(changed(FOUR_BAR, ("[links.3]", f"[links.{'x' * 41}]")))
    assert "at most 40 letters and digits" in sentence


def test_a_sliding_pair_has_its_way_of_writing() -> None:
    [sentence] = messages(changed(FOUR_BAR, (DRIVER, 'slide = "2-3"\ntravel = 1\nvelocity = 1')))
    assert '"SLIDING/GUIDING"' in sentence


def test_a_slide_on_a_link_that_does_not_guide_it_names_those_that_do() -> None:
    text = changed(SIX_BAR, ('link  = "1"\nangle = 50\nomega = -10', 'slide = "5/3"\ntravel = 3\nvelocity = 1'))
    [sentence] = messages(text)
    assert "5 does not slide on link 3; it may be 5/6" in sentence


def test_more_links_than_the_limit_is_one_sentence() -> None:
    links = "".join(f'[links.{i}]\npoints = ["A"]\n' for i in range(201))
    [sentence] = messages("[frame]\npoints = { A = [0, 0] }\n" + links)
    assert "201 moving links" in sentence


def test_all_problems_of_a_file_are_reported_together() -> None:
    text = changed(
        FOUR_BAR, ("length = 150", "length = -150"), ("length = 300", "lenght = 300"), ('"E", angle', '"Q", angle'),
        ("omega = 10", "omega = 10\nrpm = 95"), ("[driver]", "[sketch]\nZ = [0, 0]\n[printed]\nv_Y = 3\n[driver]"),
    )
    wheres = {s.split(":")[0] for s in messages(text)}
    assert wheres == {"links.1.length", "links.3.lenght", "links.2.guides.s.through", "driver.omega", "sketch.Z",
                      "printed.v_Y"}


def test_a_link_that_nothing_holds_is_reported_beside_a_misspelt_link() -> None:
    text = changed(SIX_BAR, ('on     = "6.h"', 'on     = "66.h"'), ("[driver]", '[links.7]\npoints = ["X"]\n[driver]'))
    assert [s.split(":")[0] for s in messages(text)] == ["links.5.on", "links.7"]


def test_a_misspelt_table_beside_the_right_one_is_one_problem() -> None:
    assert messages(changed(FOUR_BAR, ("[links.2]", "[link.2]"))) == ['link: unknown table; did you mean "links"?']


def test_a_misspelt_key_beside_the_right_one_is_one_problem() -> None:
    assert [s.split(":")[0] for s in messages(changed(FOUR_BAR, ("length = 150", "length = 150\nlenght = 3")))] == [
        "links.1.lenght"]


def test_a_point_taken_out_for_a_wrong_number_is_not_reported_as_unknown() -> None:
    text = changed(FOUR_BAR, ("E = [100, 50]", "E = [100, nan]"))
    assert [s.split(":")[0] for s in messages(text)] == ["links.2.at.E.2"]


def test_the_frame_is_not_offered_where_a_link_is_to_be_driven() -> None:
    with pytest.raises(SceneError) as error:
        mechanism_of_text(changed(FOUR_BAR, ('link = "1"', 'link = "7"')), "four-bar")
    assert ["known here: 1, 2, 3"] == [str(problem.wanted) for problem in error.value.problems]


def test_a_wrong_angle_of_the_driver_is_not_reported_as_missing() -> None:
    text = changed(FOUR_BAR, ("angle = 60", 'angle = "60"'))
    assert [s.split(":")[0] for s in messages(text)] == ["driver.angle"]


def test_the_second_of_several_drivers_is_named_by_its_number() -> None:
    text = changed(FOUR_BAR, ("[driver]", "[[driver]]")) + '[[driver]]\nlink = "2"\nangle = true\nomega = 0\n'
    assert [s.split(":")[0] for s in messages(text)] == ["driver.2.angle"]


def test_a_wrong_list_of_guides_is_not_reported_as_missing() -> None:
    block = '[links.5]\non = ["2", "3", "4"]\nangle_on = [0, 90]\n[driver]'
    assert [s.split(":")[0] for s in messages(changed(FOUR_BAR, ("[driver]", block)))] == ["links.5.on"]


def test_a_number_of_thousands_of_digits_is_told_in_words_of_the_scene() -> None:
    (sentence,) = messages(changed(FOUR_BAR, ("length = 150", "length = 1" + "0" * 5000)))
    assert "1e+15" in sentence


DEAD = ('angle = 50', 'angle = 1e-9\nfrom = "dead point"')


def test_an_angle_may_count_from_a_dead_point() -> None:
    driver = mechanism_of_text(changed(SIX_BAR, DEAD), "scene").drivers[0]
    assert (math.radians(1e-9), None) == (driver.distance, driver.near)


def test_a_dead_point_is_told_by_what_it_is_near_to() -> None:
    driver = mechanism_of_text(changed(SIX_BAR, (DEAD[0], DEAD[1] + "\nnear = 90")), "scene").drivers[0]
    assert (math.radians(1e-9), math.radians(90)) == (driver.distance, driver.near)


def test_near_alone_means_nothing() -> None:
    assert messages(changed(SIX_BAR, (DEAD[0], "angle = 50\nnear = 90"))) == [
        'driver.near: tells which dead point; write from = "dead point" with it']


def test_no_distance_is_the_dead_point_itself() -> None:
    [sentence] = messages(changed(SIX_BAR, (DEAD[0], DEAD[1].replace("1e-9", "0"))))
    assert sentence == "driver.angle: 0 is the dead point itself; write the distance from the dead point"


def test_a_name_that_a_wrong_entry_may_have_held_is_no_second_problem() -> None:
    four_bar = graphkin.read("fourbar-150-500-300-400").to_dict()
    four_bar["links"]["2"]["at"] = "nothing"
    four_bar["sketch"] = {"E": [10, 20]}
    with pytest.raises(SceneError) as told:
        graphkin.read(four_bar)
    assert ["links.2.at"] == [str(problem.where) for problem in told.value.problems]


LOADED = changed(SIX_BAR, ("[driver]", """[masses.2]
at = "B"
mass = 2
[loads.P]
on = "5"
at = "D"
force = 100
against = "5/6"
[balance]
on = "1"
[positions]
count = 12
first = 3
[driver]"""))


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ([("[frame]\nname   = \"6\"", "[frame]\nname   = \"6 a\"")], {"frame.name"}),
        ([('on     = "6.h"', 'on     = "6.k"')], {"links.5.on"}),
        ([("mass = 2", "mass = -2"), ("force = 100", 'force = "x"')], {"masses.2.mass", "loads.P.force"}),
        ([("mass = 2", "mass = -2"), ('at = "B"', 'at = "Q"')], {"masses.2.mass", "masses.2.at"}),
        ([("force = 100", 'force = "x"'), ('"5/6"', '"5/9"')], {"loads.P.force", "loads.P.against"}),
        ([("count = 12", "count = 0"), ("[frame]", 'find = ["v_D at 3"]\n[frame]')], {"positions.count"}),
    ],
)
def test_each_problem_is_told_with_no_other_that_follows_from_it(wrong: list[tuple[str, str]], told: set[str]) -> None:
    assert told == {sentence.split(": ")[0] for sentence in messages(changed(LOADED, *wrong))}


@pytest.mark.parametrize(
    ("scene", "key", "wrong"),
    [
        ("single-flier", "frame.points.A", [1, 2, 3]),
        ("wheel-on-rail", "contacts.K.rolling", "yes"),
        ("hypocycloid-straight-line", "gears.g", "ring"),
        ("cam-flat-face", "frame.guides.g", {"through": "A"}),
        ("cam-eccentric-flat-rocker", "links.1.discs", 50),
        ("rocker-return-spring", "links.3.at.E.from", True),
        ("boom-lifted", "links.2.on", True),
    ],
)
def test_a_wrong_entry_is_no_second_problem_where_something_refers_to_it(scene: str, key: str, wrong: object) -> None:
    made = graphkin.read(scene).to_dict()
    path = key.split(".")
    value_at(made, tuple(path[:-1]))[path[-1]] = wrong
    with pytest.raises(SceneError) as told:
        graphkin.read(made)
    assert [key] == [str(problem.where) for problem in told.value.problems]


def test_a_start_where_nothing_rolls_is_refused() -> None:
    [sentence] = messages(changed(FOUR_BAR, (LINK2, f"{LINK2}\nstart = 30")))
    assert sentence.startswith("links.2.start: nothing rolls here; leave start out")


def test_a_mass_that_is_wrong_is_something_to_balance() -> None:
    [sentence] = messages(changed(FOUR_BAR, ("[driver]", '[masses.2]\nmass = 2\n[balance]\non = "1"\n[driver]')))
    assert sentence.startswith("masses.2.at: is missing")


LAW = 'link = "1"\ntime = 0.2\nlaw = { from = 0, to = 90, duration = -1, by = "345" }'


def test_a_time_below_nought_is_no_negative_length_and_the_law_beside_it_is_not_missed() -> None:
    with pytest.raises(SceneError) as refusal:
        mechanism_of_text(changed(FOUR_BAR, (DRIVER, LAW)), "test")
    assert "driver.law.duration: found -1, a negative time; a time must be positive" == str(refusal.value)


def test_what_may_not_be_below_nought_is_not_said_of_all_numbers() -> None:
    spring = '[springs.T]\nbetween = ["A", "C"]\nrate = 1\nfree = -1\n[driver]'
    with pytest.raises(SceneError, match=r"springs\.T\.free: found -1; 0 is the least that is possible here"):
        mechanism_of_text(changed(FOUR_BAR, ("[driver]", spring)), "test")


def test_a_key_with_a_stroke_is_told_to_stand_in_quotation_marks() -> None:
    with pytest.raises(SceneError, match='keys such as "v_B/C", in quotation marks'):
        mechanism_of_text(changed(FOUR_BAR, ("[driver]", "[printed]\nd_B/D = 350\n[driver]")), "test")


PARALLEL = changed(
    FOUR_BAR, ("length = 150", "length = 300"), ("length = 500", "length = 400"),
    ("[driver]", '[links.5]\npoints = ["G", "H"]\nlength = 300\nat = { P = [50, 0] }\nredundant = true\n[driver]'),
    ("D = [400, 0]", "D = [400, 0], G = [200, 0]"), ("E = [100, 50]", "E = [100, 50], H = [200, 0]"),
)
IN_TURN = changed(LOADED, ('on = "5"\nat = "D"', 'on = "5"\nat = "D"\nwhen = HERE'))
STANDING = changed(FOUR_BAR, (DRIVER, 'link = "1"\ntime = 0.2\nlaw = HERE'))
CYLINDER = """[frame]
points = { A = [0, 0], C = [200, -300] }
[links.1]
points = ["A", "B"]
length = 400
[links.2]
points = ["B"]
on = "3"
[links.3]
points = ["C"]
[loads.Q]
on = "1"
at = "B"
force = 3
angle = -90
[driver]
slide = "2"
travel = 520
velocity = 60
"""
BESIDE = {
    # loads
    "balance alone": (FOUR_BAR, [("[driver]", '[balance]\non = "1"\n[driver]')],
                      "balance: there is nothing to balance; give [masses.LINK], [loads.NAME] or [springs.NAME]"),
    "redundant mass": (PARALLEL, [("[driver]", '[masses.5]\nat = "P"\nmass = 3\n[driver]')],
                       "masses.5: link 5 is redundant; its share of the forces is not determined; use another link"),
    "redundant spring": (PARALLEL, [("[driver]", '[springs.S]\nbetween = ["P", "D"]\nrate = 1\nfree = 5\n[driver]')],
                         "springs.S.between: link 5 is redundant; its share of the forces is not determined; use "
                         "another link"),
    "force and moment": (LOADED, [("force = 100", "force = 100\nmoment = 3")],
                         "loads.P: has both force and moment; give one of them"),
    "no force": (LOADED, [("force = 100\n", "")], "loads.P: has neither force nor moment; give one of them"),
    "against and angle": (LOADED, [("force = 100", "force = 100\nangle = 3")],
                          "loads.P.against: stands beside angle or follows; a force has one direction"),
    "when of nothing": (IN_TURN, [("HERE", "{ }")],
                        "loads.P.when: has neither stroke nor driver; give one of them"),
    "when of both": (IN_TURN, [("HERE", '{ stroke = "5/6", driver = [10, 20] }')],
                     "loads.P.when: has both stroke and driver; give one of them"),
    "when back": (IN_TURN, [("HERE", '{ stroke = "5/6", from = 0.9, to = 0.5 }')],
                  "loads.P.when: from 0.9 to 0.5; parts of the stroke grow from 0 to 1"),
    "when a turn back": (IN_TURN, [("HERE", "{ driver = [-118, -478] }")],
                         "loads.P.when.driver: found -118, -478; two different values; a load that acts always has no "
                         "when"),
    "when a turn back, rounded": (IN_TURN, [("HERE", "{ driver = [-125, -485] }")],
                                  "loads.P.when.driver: found -125, -485; two different values; a load that acts "
                                  "always has no when"),
    "when a slide goes back": (CYLINDER, [("angle = -90", "angle = -90\nwhen = { driver = [500, 400] }")],
                               "loads.Q.when.driver: found 500, 400; the travel grows between them"),
    "balance without place": (LOADED, [('on = "1"\n[positions]', 'on = "1"\nangle = 20\n[positions]')],
                              "balance.angle: stands without at; a force has a place; a moment has no direction"),
    # drivers
    "dead point of drawn points": (changed(SIX_BAR, DEAD), [("[driver]", "[drawn]\nB = [78, 373]\n[driver]")],
                                   "driver.from: with [drawn] the value of the driver follows from the points; leave "
                                   "one of the two out"),
    "no position": (SIX_BAR, [("angle = 50", 'position = "3"')],
                    'driver.position: there is no position "3"; name it in [positions]'),
    "position without first": (LOADED, [("angle = 50", 'position = "3"'), ("first = 3\n", "")],
                               "driver.position: the numbered positions count from the driver's own value; write "
                               "positions.first, or the angle"),
    "position and angle": (LOADED, [("angle = 50", 'angle = 50\nposition = "3"')],
                           "driver.position: found angle = 50 too; write one of the two"),
    "law of nothing": (STANDING, [("HERE", "{ from = 3 }")],
                       'driver.law: says nothing; write { from = 20, to = 110, duration = 0.5, by = "cycloidal" }, or '
                       "from and pieces, or a table"),
    "law by two": (STANDING, [("HERE", "{ from = 3, to = 90, table = [[0, 1], [1, 2]] }")],
                   'driver.law: says its motion by table, by; write { from = 20, to = 110, duration = 0.5, by = '
                   '"cycloidal" }, or from and pieces, or a table'),
    "law from nowhere": (STANDING, [("HERE", '{ to = 90, duration = 1, by = "345" }')],
                         "driver.law.from: is missing; write the driver's value at 0 s"),
    "law by nothing": (STANDING, [("HERE", "{ from = 0, to = 90, duration = 1 }")],
                       'driver.law.by: is missing; write by = "cycloidal", "harmonic", "345" or another law'),
    "pieces back": (STANDING, [("HERE", '{ from = 0, pieces = [{ to = 1, rise = 20, by = "345" }, { to = 0.5 }] }')],
                    "driver.law.pieces.2: ends at 0.5 s, where it begins at 1; seconds grow"),
    "table from": (STANDING, [("HERE", "{ from = 0, table = [[0, 1], [1, 2]] }")],
                   "driver.law.from: stands beside a table; the table says where it begins"),
    "table of one": (STANDING, [("HERE", "{ table = [[0, 1]] }")],
                     "driver.law.table: has one row; write [[time, value], ...], two rows or more"),
    # questions
    "positions of a slide": (CYLINDER, [("[driver]", "[positions]\ncount = 12\n[driver]")],
                             "positions.count: the driver slides, it makes no turn; name its positions in "
                             "positions.also, by travel"),
    "stroke of a slide": (
        CYLINDER, [("[driver]", '[positions]\nalso = { x = { stroke = "2/3", at = 0, sense = 1 } }\n[driver]')],
        "positions.also.x: the driver slides, there is no stroke of a whole turn; give a travel"),
    "printed by hand": (FOUR_BAR, [("[driver]", '[printed]\nby = "hand"\n[driver]')],
                        'printed.by: found \'hand\'; one of "drawing", "computation" is possible'),
    "row of two": (FOUR_BAR, [("[driver]", "[[printed_rows]]\nat = [1, 2]\n[driver]")],
                   "printed_rows.1.at: is two numbers; write the driver's value, or the name of a position"),
    "row at no position": (FOUR_BAR, [("[driver]", '[[printed_rows]]\nat = "7"\n[driver]')],
                           'printed_rows.1.at: there is no position "7"; name positions in [positions], or write a '
                           "driver value"),
    "loop of two": (FOUR_BAR, [("[driver]", '[loops]\nI = ["A", "B"]\n[driver]')],
                    "loops.I: has 2 points; a loop goes through three points or more"),
    "loop that closes": (FOUR_BAR, [("[driver]", '[loops]\nI = ["A", "B", "C", "A"]\n[driver]')],
                         "loops.I: comes twice to one point; name each point once; it closes by itself"),
}


@pytest.mark.parametrize("rule", BESIDE)
def test_what_stands_beside_or_is_left_out_is_told_in_one_sentence(rule: str) -> None:
    text, changes, sentence = BESIDE[rule]
    assert [sentence] == messages(changed(text, *changes))


def test_a_truth_at_which_a_printed_row_stands_is_not_missing_too() -> None:
    [sentence] = messages(changed(FOUR_BAR, ("[driver]", "[[printed_rows]]\nat = true\n[driver]")))
    assert sentence.startswith("printed_rows.1.at: found true; write a number")


def test_a_position_beside_the_distance_from_a_dead_point_is_one_problem():
    driver = '[positions]\nalso = { a = 30 }\n[driver]\nposition = "a"\nfrom = "dead point"\nnear = 60\n'
    with pytest.raises(SceneError) as refused:
        mechanism_of_text(changed(FOUR_BAR, ("[driver]\n", driver)), "scene")
    assert ["driver.position: what gives the driver's value stands here twice; leave one of them out"] == [
        str(problem) for problem in refused.value.problems
    ]
