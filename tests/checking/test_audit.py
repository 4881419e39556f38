"""Judging stated values: published errors are found, right ones passed, common slips called by their names."""

from __future__ import annotations

import json
from dataclasses import replace

import pytest

import graphkin
from graphkin import solver
from graphkin.api.classroom.audited import evidence_at
from graphkin.checking.audit import judge
from graphkin.checking.slip_likelihood import Suspect, clearest, transcription_errors
from graphkin.checking.slips import Evidence
from graphkin.construction import plan_with_forces
from graphkin.errors import CallError
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol, stated
from graphkin.scene.tables import Units
from graphkin.words import Phrase, say
from tests.command import run

SIXBAR = "sixbar-guide-40deg"
TABLE = "sixbar-rotating-guide-35rpm"


def verdicts(audited):
    return {v["symbol"]: v["verdict"] for v in audited.data["values"]}


def judged(scene, at=None, **values):
    """The entry of the last of one person's values; @ is written _at_ and / is written _to_."""
    named = {k.replace("_at_", "@").replace("_to_", "/"): v for k, v in values.items()}
    return graphkin.audit(scene, answers={"A": named}, at=at).data["values"][-1]


def test_every_published_value_of_the_six_bar_passes():
    assert {"right", "within drafting accuracy"} == set(verdicts(graphkin.audit(SIXBAR)).values())


def test_of_the_shaper_only_the_acceleration_of_the_ram_is_wrong():
    assert ["a_C"] == [s for s, v in verdicts(graphkin.audit("shaper-scheme-2")).items() if v == "wrong"]


@pytest.mark.parametrize(
    ("scene", "symbol"), [("hit16-double-guide", "alpha_5"), (TABLE, "v_D"), ("slotter-75-150", "v_C")]
)
def test_a_published_error_is_found(scene, symbol):
    assert "wrong" == verdicts(graphkin.audit(scene))[symbol]


@pytest.mark.parametrize("scene", ["rotating-guide-bar", "cam-eccentric-flat-rocker"])
def test_a_value_right_to_its_digits_is_right(scene):
    assert {"right"} == set(verdicts(graphkin.audit(scene)).values())


def test_the_slotter_was_taken_from_the_other_assembly():
    assert "other assembly" in graphkin.audit("slotter-75-150").data["values"][0]["looks_like"]


def test_a_number_copied_wrong_is_told_with_what_stood_there():
    assert "a slip of the pen for 1293.698" == graphkin.audit(TABLE).data["values"][0]["looks_like"]


def test_a_value_of_another_column_is_wrong_even_within_drafting_accuracy():
    entry = judged(TABLE, -120, a_D="4920.073")
    assert ("wrong", "another column: the x component of a_S4") == (entry["verdict"], entry["looks_like"])


def test_a_value_of_another_position_is_told_with_it():
    assert "another position" in judged(TABLE, -60, v_D="434.0523")["looks_like"]


def test_drawings_in_pencil_are_within_drafting_accuracy():
    people = {}
    for seed in range(2):
        rows = graphkin.check(SIXBAR, instrument="pencil", seed=seed).data["readings"]
        people[str(seed)] = {r["symbol"]: f"{r['measured']:.4g}" for r in rows}
    assert graphkin.audit(SIXBAR, answers=people).ok


@pytest.mark.parametrize(
    ("values", "name"),
    [
        ({"omega_3": "2.819"}, "sign"),
        ({"v_D": "0.4827"}, "wrong unit: 0.001 times"),
        ({"omega_3": "-26.92"}, "wrong unit: r/min"),
        ({"a_D": "55.4668"}, "velocity scale used for acceleration"),
        ({"a_D": "1126"}, "Coriolis left out (ak_D@4/D@3)"),
        ({"a_D": "1698"}, "Coriolis reversed (ak_D@4/D@3)"),
        ({"a_D": "4609"}, "Coriolis reversed (ak_B@3/B@2, ak_D@4/D@3)"),
        ({"a_B_at_3": "3030"}, "normal term only"),
        ({"a_B_at_3": "2515"}, "tangential term only"),
        ({"v_D": "99.2"}, "a relative vector taken for the absolute one: v_D@4/D@3"),
        ({"v_D": "48.3"}, "millimetres on paper"),
    ],
)
def test_a_common_slip_is_called_by_its_name(values, name):
    entry = judged(SIXBAR, **values)
    assert "wrong" == entry["verdict"]
    assert name in entry["looks_like"]


def test_a_force_is_right_without_and_with_a_load_that_begins_just_there():
    engine = graphkin.read("engine-gas-force").to_dict()
    engine["loads"]["gas"]["when"] = {"driver": [30, 180]}
    del engine["flywheel"]
    row = {"at": 30, "by": "computation"}
    stated = [row | {"M_2": 66.423, "F_3/4": 1511.34}, row | {"M_2": -116.31, "F_3/4": 4546.2}]
    scene = graphkin.read(engine | {"printed_rows": stated})
    assert ["right"] * 4 == [value["verdict"] for value in graphkin.audit(scene).data["values"]]
    motion = solver.solve(mechanism_of(scene))
    drawn = Evidence.of(plan_with_forces(motion.structure, None, (), ()), motion, {})
    for own in mechanism_of(scene).question.stated:
        assert ["right"] * 2 == [value.verdict for value in judge(drawn, tuple(own.values.values()))]


@pytest.mark.parametrize(
    ("symbol", "said"), [("s_2/3", "3644"), ("s_2/3", "6.66"), ("theta_3", "8.183"), ("theta_3", "7.814")]
)
def test_a_position_is_in_no_unit_of_a_rate_and_an_angle_in_none_of_a_length(symbol, said):
    assert "looks_like" not in judged(SIXBAR, **{symbol: said})


@pytest.mark.parametrize(
    ("scene", "symbol", "said"),
    [
        ("geared-five-bar", "alpha_1", "-3"), ("geared-five-bar", "omega_1", "-6"), ("wheel-on-rail", "omega_1", "2"),
        ("geneva-step", "omega_1", "-10"),
    ],
)
def test_a_wrong_sign_is_named_of_a_number_of_one_figure_too(scene, symbol, said):
    assert "sign" == judged(scene, **{symbol: said})["looks_like"]


def test_a_slip_is_named_alone_where_a_second_of_its_kind_besides_has_no_effect():
    # α₃ follows from ak_B@3/B@2 alone; both Coriolis terms left out give the same
    assert "Coriolis left out (ak_B@3/B@2)" == judged(SIXBAR, alpha_3="15.079")["looks_like"]


@pytest.mark.parametrize(
    ("count", "named"), [(1, "sign"), (3, "sign or other assembly or half the right value"), (4, None)]
)
def test_of_slips_that_fit_equally_all_are_named_unless_they_are_many(count, named):
    phrases = [Phrase(f"slip {key}") for key in ("sign", "assembly", "half", "double")]
    best = clearest([(Suspect(phrase, 1.0, 0.1), 1.0) for phrase in phrases[:count]], chance=0.1)
    assert named == (best and str(best.phrase).partition(" (")[0])


def test_the_normal_term_alone_is_known_where_the_image_gave_the_point():
    assert "normal term only (an_B/O4)" == judged("shaper-scheme-2", a_B="317.3")["looks_like"]
    # a component that stands in the polygon is not told a second time as another quantity
    assert "normal term only (an_C/B)" == judged("slider-crank-offset", a_C="3938.9")["looks_like"]


def test_what_follows_from_an_earlier_wrong_value_is_told_with_it():
    # at = 8998 is the Coriolis term reversed; a = hypot(3033, 8998) and alpha = at / BC are right on their own inputs
    entry = judged(SIXBAR, an_B_at_3_to_C="3033", at_B_at_3_to_C="8998", alpha_3="23.58")
    assert ("right from own values", ["at_B@3/C"]) == (entry["verdict"], entry["follows_from"])


@pytest.mark.parametrize("name", ["two-coriolis", "hydraulic-cylinder", "triad-slider", "gears-epicyclic"])
def test_what_follows_does_not_depend_on_what_somebody_else_took_before(name):
    case = evidence_at(mechanism_of("sixbar-guide-40deg" if name == "two-coriolis" else name), [], None)
    together, symbols = case, [s for s in case.others if s.scope == "motion" and case.exact(s)]
    for number, symbol in enumerate(symbols):
        own = {s: 1.1 * case.exact(s) for s in symbols[number % 3 :: 3]}
        together.following({s: 1.3 * case.exact(s) for s in symbols}, symbol)
        alone = replace(case).following(own, symbol)
        assert alone == together.following(own, symbol)


def test_a_normal_component_follows_the_square_of_a_wrong_velocity():
    case = evidence_at(mechanism_of("fourbar-150-500-300-400"), [], None)
    speed, normal = Symbol.parse("v_C"), Symbol.parse("an_C/D")
    (followed,) = case.following({speed: 1.1 * abs(case.exact(speed))}, normal)
    assert 1.21 == pytest.approx(abs(followed / case.exact(normal)))


def test_a_wrong_angular_velocity_is_followed_to_a_point_far_from_it():
    entry = judged(SIXBAR, omega_3="-3.5", v_D_at_3="586.5")
    assert "right from your own omega_3" == entry["looks_like"]


def test_a_sun_taken_for_its_planet_is_told():
    # Willis with 20 teeth for the sun's 30: 10 * 20 / (20 + 70)
    assert "teeth" in judged("gears-epicyclic", omega_2="2.222")["looks_like"]


def test_the_teeth_of_a_single_mesh_exchanged_are_told() -> None:
    wheels = {
        "frame": {"points": {"A": [0, 0], "B": [60, 0]}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"]}},
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, 40]}},
        "driver": {"link": "1", "angle": 0, "omega": 10},
    }
    # 10 * 40 / 20 for 10 * 20 / 40
    assert "numbers of teeth exchanged (gear g)" == judged(wheels, omega_2="-20")["looks_like"]


def test_a_carrier_taken_as_fixed_is_told() -> None:
    # the planet turned by a sun of 30 teeth as if its arm stood: 10 * 30 / 20
    told = judged("gears-epicyclic", omega_3="-15")["looks_like"]
    assert "the carrier taken as fixed (gear sun) or twice the right value (diameter for radius)" == told


def test_a_wrong_value_that_nothing_explains_has_no_name():
    assert "looks_like" not in judged(SIXBAR, v_D="701")


def test_slips_drawn_out_in_any_mechanism_are_found_again():
    scene = mechanism_of("shaper-scheme-2")
    for phrase, _, values in evidence_at(scene, [], None).altered:
        wrong = abs(values(Symbol.parse("a_C"))) * 1e3
        if "coriolis" in phrase.key and abs(wrong - 4137.5) > 300:
            assert say(phrase) == judged(scene, a_C=f"{wrong:.5g}")["looks_like"]


def test_half_a_unit_of_the_last_digit_is_right_and_more_is_not():
    assert ["right", "within drafting accuracy"] == [judged(SIXBAR, v_D=t)["verdict"] for t in ("482.7", "482.8")]


def test_digits_are_those_written():
    printed = stated(Symbol.parse("v_D"), ["480.0"], Units())
    assert (4, pytest.approx(1e-4)) == (printed.digits, printed.step)


def test_two_digits_exchanged_are_among_the_transcription_errors():
    assert 482.7 in [v for _, _, v in transcription_errors(stated(Symbol.parse("omega_3"), ["428.7"], Units()))]


def test_people_and_positions_are_read_from_a_table(tmp_path):
    (tmp_path / "a.csv").write_bytes("姓名;at;v_D\n王;-60;1293.695\n李;-90;1466.08\n".encode("gb18030"))
    found = graphkin.audit(TABLE, answers=tmp_path / "a.csv").data["values"]
    assert [("王", -60, "right"), ("李", -90, "right")] == [(v["person"], v["at"], v["verdict"]) for v in found]


def test_everything_wrong_with_the_heads_of_a_table_is_said_at_once(tmp_path):
    (tmp_path / "a.csv").write_text("name,v_Q,v_D,v_D (kg),a_D\nx,1,1,1,2\n")
    with pytest.raises(CallError) as refusal:
        graphkin.audit(TABLE, answers=tmp_path / "a.csv")
    assert 3 == len(refusal.value.problems)


def test_one_bad_cell_is_a_verdict_of_its_own_and_the_rest_is_judged(tmp_path):
    (tmp_path / "a.csv").write_text("name,v_D,a_D\nx,many,\ny,1293.7,nan\n")
    found = graphkin.audit(TABLE, answers=tmp_path / "a.csv", at=-60).data["values"]
    assert ["not readable", "missing", "right", "not readable"] == [v["verdict"] for v in found]


@pytest.mark.parametrize("text", ["", "v_D\n", "name,mark\nx,3\n"])
def test_a_table_without_answers_is_refused(tmp_path, text):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(CallError):
        graphkin.audit(TABLE, answers=tmp_path / "a.csv")


def test_a_name_cannot_write_into_the_page():
    page = graphkin.audit(SIXBAR, answers={"<script>": {"v_D": 480}})._repr_html_()
    assert "<script>" not in page


def test_the_command_prints_the_json_of_the_contract_and_exits_1(tmp_path):
    done = run("audit", "shaper-scheme-2", "--json", "-o", "o", cwd=tmp_path)
    rows = {v["symbol"]: v for v in json.loads(done.stdout)["values"]}
    assert (1, -13.47) == (done.returncode, pytest.approx(rows["a_C"]["deviation_pct"], abs=0.01))
    assert (tmp_path / "o" / "audit.csv").exists()


def test_a_scene_without_printed_values_is_refused():
    with pytest.raises(CallError):
        graphkin.audit("toggle-press")


def test_a_number_so_small_that_no_double_holds_its_last_digit_is_refused():
    with pytest.raises(ValueError, match="no number of a size that can be meant"):
        stated(Symbol.parse("v_D"), ["1e-400"], Units())


COMPUTED = {"by": "computation"}


@pytest.mark.parametrize(
    ("text", "verdict"),
    [("-114.397", "right"), ("114.397", "wrong"), ("+114.397", "wrong"), ("114.397 mm/s ←", "right")],
)
def test_a_computed_velocity_along_a_guide_is_read_with_its_sign(text, verdict):
    scene = graphkin.read("slotter-75-150").to_dict() | {"printed": COMPUTED | {"v_C": text}}
    (found,) = graphkin.audit(scene).data["values"]
    assert (verdict, "sign" if verdict == "wrong" else None) == (found["verdict"], found.get("looks_like"))


def test_a_computed_velocity_without_a_line_of_its_own_is_a_size():
    scene = graphkin.read("slotter-75-150").to_dict() | {"printed": COMPUTED | {"v_A": "471.239"}}
    assert ["right"] == [v["verdict"] for v in graphkin.audit(scene).data["values"]]


@pytest.mark.parametrize(("text", "verdict"), [("482.7", "right"), ("+482.7", "wrong"), ("-482.7", "right")])
def test_what_was_drawn_is_a_size_unless_a_sign_is_written(text, verdict):
    assert verdict == judged(SIXBAR, v_D=text)["verdict"]


def test_a_vector_is_right_whose_components_are_rounded_each():
    # -3079.455, -2452.265
    assert "right" == judged(SIXBAR, a_B_at_3=[-3079, -2452])["verdict"]


@pytest.mark.parametrize(("first", "verdict"), [("114.397", "right"), ("-114.397", "wrong")])
def test_one_sign_in_a_column_makes_its_numbers_signed(first, verdict):
    # a ram that goes to the left at both: -114.397, -110.397
    rows = [{"at": 0, "v_C": first}, {"at": 180, "v_C": "110.397"}]
    scene = graphkin.read("slotter-75-150").to_dict() | {"printed": {}, "printed_rows": rows}
    assert verdict == graphkin.audit(scene).data["values"][1]["verdict"]


def computed(rows):
    """The verdicts of a table of the six-bar of 420 r/min, by driver value and symbol."""
    rows = [{"at": at, "omega_4": w, "v_F": v, "a_F": a, **COMPUTED} for at, (w, v, a) in rows.items()]
    source = graphkin.read("sixbar-420rpm").to_dict() | {"printed": {}, "printed_rows": rows}
    return {(v["at"], v["symbol"]): v["verdict"] for v in graphkin.audit(source).data["values"]}


# worked out by hand: angles to 0.01 degrees, omega_1 = 43.98 rad/s, every rate to five digits
ROUNDED = {
    0: ("0.2455", "0.7233", "-138.549"), 45: ("-0.1904", "-1.4535", "-80.061"), 90: ("1.8925", "-1.9290", "20.035"),
    135: ("3.0651", "-1.1393", "56.638"), 180: ("0.7948", "-0.2051", "44.693"), 225: ("-1.8131", "0.5122", "39.966"),
    270: ("-2.8897", "1.3622", "56.209"), 315: ("-1.1077", "2.1287", "1.3116"),
}


def test_values_computed_with_rounded_numbers_are_right():
    assert {"right"} == set(computed(ROUNDED).values())


@pytest.mark.parametrize("slip", [lambda v: f"{1.01 * float(v):.4f}", lambda v: f"{-float(v):.4f}"])
@pytest.mark.parametrize(("at", "column"), [(0, 2), (90, 0), (90, 1), (135, 2), (180, 1), (225, 1), (270, 2)])
def test_a_computed_value_that_is_one_per_cent_or_a_sign_off_is_wrong(slip, at, column):
    row = list(ROUNDED[at])
    row[column] = slip(row[column])
    assert [(at, ("omega_4", "v_F", "a_F")[column])] == [
        place for place, verdict in computed({**ROUNDED, at: row}).items() if verdict != "right"
    ]


def test_a_computed_value_a_little_off_by_its_inputs_is_no_slip_of_the_pen():
    rows = [{"at": 50, "omega_3": "-2.81867", "alpha_3": "6.57775", **COMPUTED}]  # with A at 280.056 mm, not 280
    source = graphkin.read(SIXBAR).to_dict() | {"printed": {}, "printed_rows": rows}
    assert [None, None] == [value.get("looks_like") for value in graphkin.audit(source).data["values"]]


def test_a_computed_acceleration_without_its_normal_term_is_wrong():
    source = graphkin.read("sixbar-420rpm").to_dict()
    alpha = graphkin.solve("sixbar-420rpm", at=45)["alpha_3"][0]
    for printed, verdict in ((f"{0.3 * abs(alpha):.3f}", "wrong"), (None, "right")):
        size = printed or f"{abs(graphkin.solve('sixbar-420rpm', at=45)['a_C'][0]):.3f}"
        (found,) = graphkin.audit(source | {"printed": COMPUTED | {"a_C": size}}).data["values"]
        assert verdict == found["verdict"]


def test_a_value_that_no_drawing_determines_is_not_said_to_lie_beside_a_dead_point():
    # the rod stands nearly square to the planet's rim, far from any dead point: its rate hardly changes
    train = {
        "frame": {"points": {"O": [0, 0]}, "guides": {"x": {"through": [0, 10], "angle": 0}}},
        "links": {
            "s": {"points": ["O"]}, "h": {"points": ["O", "P"], "length": 60}, "r": {"points": ["O"]},
            "p": {"points": ["P"], "at": {"T": [20, 0]}}, "q": {"points": ["T", "W"], "length": 150},
            "w": {"points": ["W"], "on": "0.x"},
        },
        "gears": {"a": {"between": ["s", "p"], "teeth": [40, 20]}, "b": {"between": ["p", "r"], "teeth": [20, -80]}},
        "driver": [{"link": "s", "angle": 0, "omega": 10, "alpha": 2}, {"link": "r", "angle": 0, "omega": -5}],
        "sketch": {"W": [200, 0]}, "printed": {"alpha_q": "-0.4773"},
    }
    (value,) = graphkin.audit(train).data["values"]
    assert (None, True) == (value["verdict"], value["why"].startswith("the error of a drawing may be larger here"))


STEPHENSON = {
    "frame": {"points": {"A": [0, 0], "D": [90, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B", "C"], "length": 80, "at": {"E": [60, 40]}},
        "3": {"points": ["D", "C"], "length": 60},
    },
    "sketch": {"C": [90, 60]},
    "driver": {"link": "1", "angle": 75, "omega": 8, "alpha": 20},
}


@pytest.mark.parametrize(
    ("symbol", "said", "looks_like"),
    [
        ("v_C", "205.0", ""),  # the right value is 196.97, its x component 195.10
        ("v_E", "99.4", "the value of another quantity: v_C/B (3 % off)"),  # 96.48
        ("v_E", "96.488", "the value of another quantity: v_C/B"),
        # what chance explains as well has no name, and what fits equally is named all
        ("v_C", "143.4", ""), ("a_E", "2723", ""), ("v_E", "230", ""), ("a_C", "920.6", ""), ("v_E", "101.1", ""),
        ("v_C", "160.6", "the value of another quantity: v_E or another column: the x component of v_E"),
    ],
)
def test_a_guessed_slip_is_clearly_the_likeliest_and_its_distance_is_named(symbol, said, looks_like):
    (row,) = graphkin.audit(STEPHENSON, answers={"Ann": {symbol: said}}).rows
    assert ["wrong", looks_like] == row[-2:]


def test_an_acceleration_by_ones_own_rates_follows_from_them():
    # 60 mm · √(3.2828⁴ + 38.5²), where the angular acceleration is 27.49
    values = graphkin.audit(STEPHENSON, answers={"Ann": {"alpha_3": "38.5", "a_C": "2398.8"}}).data["values"]
    assert [("wrong", None), ("right from own values", ["alpha_3"])] == [
        (value["verdict"], value.get("follows_from")) for value in values
    ]


def test_own_values_with_which_trial_polygons_cannot_be_divided_are_judged_all_the_same():
    scene = {
        "frame": {
            "points": {"A": [-30, 30]},
            "guides": {"s": {"through": [-25, 28], "angle": 8}, "t": {"through": "A", "angle": 24}},
        },
        "links": {
            "1": {"on": "0.s", "at": {"B": [-96, 84], "C": [8, 50]}},
            "2": {"points": ["A"]},
            "3": {"points": ["C", "D"], "length": 40},
            "4": {"on": "0.t", "points": ["D"]},
        },
        "pins": {"B": {"of": "1", "in": "2"}},
        "driver": {"link": "3", "angle": -159, "omega": 10, "relative_to": "2"},
        "sketch": {"B": [-95, 103], "C": [13, 83], "D": [48, 64]},
    }
    own = {"alpha_2": 34.0, "v_B": 630, "omega_3": -5.96}
    assert {"wrong"} == {entry["verdict"] for entry in graphkin.audit(scene, answers={"A": own}).data["values"]}


def test_each_row_of_a_drawn_table_is_held_against_the_pencil_at_its_own_position() -> None:
    four_bar = graphkin.read("fourbar-150-500-300-400").to_dict() | {"printed": {"by": "drawing"}}
    exact = graphkin.solve(four_bar, sweep=8)
    rows = [{"at": 45 * k, "omega_3": omega + 1.0} for k, omega in enumerate(exact["omega_3"].tolist())]
    alone, together = (
        [value["bound"] for few in parts for value in graphkin.audit(four_bar | {"printed_rows": few}).data["values"]]
        for parts in ([rows[:4], rows[4:]], [rows])
    )
    assert pytest.approx(alone) == together
