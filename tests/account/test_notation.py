"""Letters of quantities, the same on sheets, on papers and on diagrams."""

import pytest

from graphkin.account.notation import Notation
from graphkin.scene.symbol import PointRef, Symbol

pytestmark = pytest.mark.quick


@pytest.mark.parametrize(("chinese", "us", "name"), [
    ("v_{61}", "V_{61}", "v_6/1"),
    ("a_{10,1}", "A_{10,1}", "a_10/1"),
    ("s_{61}", "s_{61}", "s_6/1"),
    ("v_{Cx}", "V_{Cx}", "v_C.x"),
    ("v_{B3C}", "V_{B3/C}", "v_B@3/C"),
    ("θ_{32}", "θ_{32}", "theta_3/2"),
    ("F_{R56}", "F_{56}", "F_5/6"),
    ("F_{1,B}", "F_{1,B}", "F_1@B"),
    ("F_{1,B3}", "F_{1,B3}", "F_1@B@3"),
])
def test_a_quantity_is_written_in_the_letters_of_its_school(chinese: str, us: str, name: str):
    schools = (Notation("chinese"), Notation("us"))
    assert [f"${chinese}$", f"${us}$"] == [repr(school.vector(Symbol.parse(name))) for school in schools]


def test_the_transmission_angle_of_a_group_has_the_letter_of_an_angle_between_links():
    assert "$γ_{45}$" == repr(Notation("chinese").vector(Symbol("transmission", name="4-5")))


@pytest.mark.parametrize(("shown", "ref"), [("$O_{4,2}$", "O4@2"), ("$B_{2}$", "B@2"), ("$O_{4}$", "O4")])
def test_a_point_of_a_link_bears_the_link_as_a_further_index(shown: str, ref: str):
    point, _, link = ref.partition("@")
    assert shown == repr(Notation("chinese").coincident(PointRef(point, link)))
