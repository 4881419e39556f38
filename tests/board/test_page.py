"""The board in a real browser: points pulled, text typed, mechanisms built by mouse and by keys."""

from __future__ import annotations

import time
import tomllib

import pytest

import graphkin
from graphkin.scene.scene import library_text
from tests.board.served import served

pytest.importorskip("uvicorn", reason="the extra live is not installed")


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = tmp_path_factory.mktemp("page")
    own = library_text("sixbar-420rpm")
    (folder / "mine.toml").write_text(own, encoding="utf-8")
    clockwise = own.replace("[driver]\n", '[driver]\nsense = "clockwise"\n') + "# clockwise\n"
    (folder / "clockwise.toml").write_text(clockwise, encoding="utf-8")
    with served(".", cwd=folder) as (address, _):
        yield address


@pytest.fixture(scope="module")
def tab(browser, url):
    one = browser.new_context().new_page()
    one.said, one.asked = [], []
    one.on("console", lambda message: one.said.append(message.text))
    one.on("pageerror", lambda error: one.said.append(str(error)))
    one.on("request", lambda request: one.asked.append(request.url))
    one.goto(url)
    yield one
    one.context.close()


@pytest.fixture
def page(tab, url):
    """The page loaded anew, with nothing kept from before."""
    tab.set_viewport_size({"width": 1400, "height": 1000})
    tab.evaluate("[localStorage, sessionStorage].forEach(store => store.clear())")
    tab.said.clear()
    tab.asked.clear()
    tab.goto(url)
    tab.wait_for_selector("dialog[open] [data-new]")
    yield tab
    assert [] == tab.said
    assert all(address.startswith((url, "data:", "blob:")) for address in tab.asked)


def open_scene(page, name: str = "mine.toml") -> None:
    page.click(f'[data-scene="{name}"]')
    page.wait_for_selector("[data-figure=velocity] svg")


def text_of(page) -> str:
    return page.evaluate("document.getElementById('board').board.editor.text")


def until(page, expression: str, arg: object = None):
    """What an expression of the page gives as soon as it is true; asked from outside, since the page forbids eval."""
    end = time.monotonic() + 15
    while not (found := page.evaluate(expression, arg)):
        assert time.monotonic() < end, expression
        page.wait_for_timeout(30)
    return found


def middle(page, selector: str) -> tuple[float, float]:
    """Where an element stands, also while figures are drawn anew."""
    return tuple(until(
        page,
        """selector => { const one = document.querySelector(selector);
           if (!one) return null; const box = one.getBoundingClientRect();
           return box.width ? [box.x + box.width / 2, box.y + box.height / 2] : null; }""", arg=selector,
    ))


def pull(page, start: tuple[float, float], end: tuple[float, float], let_go: bool = True) -> None:
    page.mouse.move(*start)
    page.mouse.down()
    for i in range(1, 6):
        page.mouse.move(start[0] + (end[0] - start[0]) * i / 5, start[1] + (end[1] - start[1]) * i / 5)
    if let_go:
        page.mouse.up()


def agrees(page) -> None:
    page.wait_for_selector(".agrees")


def test_the_image_b_follows_when_B_is_pulled_and_all_is_checked_when_it_rests(page) -> None:
    open_scene(page)
    before = page.evaluate("document.querySelector('[id=v_B] line').outerHTML")
    x, y = middle(page, "[data-point=B]")
    pull(page, (x, y), (x - 40, y + 15), let_go=False)
    until(page, """before => { const v = document.querySelector('[id=v_B] line');
                   return v && v.outerHTML !== before }""", arg=before)
    page.mouse.up()
    until(page, "document.getElementById('board').board.state.at?.['1'] > 60")
    agrees(page)
    assert text_of(page) == library_text("sixbar-420rpm")


def test_a_pulled_joint_is_written_into_the_text_and_undone(page) -> None:
    open_scene(page)
    x, y = middle(page, "[data-point=C]")
    pull(page, (x, y), (x + 12, y - 9))
    until(page, "!document.getElementById('board').board.editor.text.includes('length = 0.34\\n')")
    agrees(page)
    assert "# coupler" in text_of(page)
    page.click("button:has-text('Undo')")
    until(page, "document.getElementById('board').board.editor.text.includes('length = 0.34\\n')")
    assert library_text("sixbar-420rpm") == text_of(page)


def test_nothing_is_undone_before_the_scene_that_was_opened(page) -> None:
    open_scene(page)
    page.click("button:has-text('Undo')")
    page.click(".cm-content")
    page.keyboard.press("Control+z")
    assert library_text("sixbar-420rpm") == text_of(page)
    page.click("button:has-text('Scenes')")
    page.click("[data-scene='clockwise.toml']")
    until(page, "document.getElementById('board').board.editor.text.includes('# clockwise')")
    page.click("button:has-text('Undo')")
    assert text_of(page).endswith("# clockwise\n")


def test_an_emptied_text_does_not_outlive_a_reload(page) -> None:
    open_scene(page)
    page.click(".cm-content")
    page.keyboard.press("Control+a")
    page.keyboard.press("Delete")
    until(page, "document.getElementById('board').board.editor.text === ''")
    page.reload()
    page.wait_for_selector("[data-figure=velocity] svg")
    assert library_text("sixbar-420rpm") == text_of(page)


def test_points_are_pulled_with_the_keys(page) -> None:
    open_scene(page)
    page.focus("[data-point=D]")
    page.keyboard.press("ArrowRight")
    until(page, "!document.getElementById('board').board.editor.text.includes('D = [0.4, -0.2]')")
    assert pytest.approx(0.405) == tomllib.loads(text_of(page))["frame"]["points"]["D"][0]
    until(page, "document.activeElement.getAttribute('data-point') === 'D'")


def test_a_wrong_length_is_told_at_its_line_and_the_figures_stay(page) -> None:
    open_scene(page)
    page.click(".cm-line:has-text('length = 0.34')")
    page.keyboard.press("End")
    for _ in "0.34":
        page.keyboard.press("Backspace")
    page.keyboard.type("-3")
    told = page.wait_for_selector(".problems li")
    assert "line 20: links.2.length: found -3" in told.inner_text()
    page.wait_for_selector(".cm-lint-marker-error")
    assert page.query_selector("[data-figure=velocity] svg") is not None
    page.keyboard.press("Backspace")
    page.keyboard.press("Backspace")
    page.keyboard.type("0.36")
    agrees(page)


def test_the_form_changes_the_text(page) -> None:
    open_scene(page)
    page.click("[data-tab=form]")
    page.fill("[name='links.3.length']", "")
    page.keyboard.press("Enter")
    assert "0.3" == page.input_value("[name='links.3.length']")
    page.fill("[name='links.3.length']", "0.31")
    page.keyboard.press("Enter")
    until(page, "document.getElementById('board').board.editor.text.includes('length = 0.31\\n')")
    agrees(page)


def test_a_scale_is_wished_in_the_form_and_left_to_the_program_again(page) -> None:
    open_scene(page)
    page.click("[data-tab=form]")
    page.fill("[name='sheet.velocity_scale']", "0.1")
    page.keyboard.press("Enter")
    until(page, "document.getElementById('board').board.editor.text.includes('velocity_scale = 0.1')")
    agrees(page)
    page.fill("[name='sheet.velocity_scale']", "")
    page.keyboard.press("Enter")
    until(page, "!document.getElementById('board').board.editor.text.includes('velocity_scale')")


def place_of(page, name: str) -> tuple[float, float]:
    return tuple(until(
        page,
        """name => { const all = [...document.querySelectorAll('.sketch .point-name')];
           const i = all.findIndex(one => one.textContent === name); if (i < 0) return null;
           const box = document.querySelectorAll('.sketch .joint')[i].getBoundingClientRect();
           return [box.x + box.width / 2, box.y + box.height / 2]; }""", arg=name,
    ))


def test_a_four_bar_is_built_by_mouse_and_gets_its_checked_sheet(page) -> None:
    page.click("[data-new=empty]")
    box = page.wait_for_selector(".sketch").bounding_box()
    page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + 0.7 * box["height"])
    place_of(page, "A")
    page.mouse.click(box["x"] + 0.8 * box["width"], box["y"] + 0.7 * box["height"])
    place_of(page, "B")
    page.click("[data-tool=bar]")
    a, b = place_of(page, "A"), place_of(page, "B")
    wide = b[0] - a[0]
    pull(page, a, (a[0] + 0.15 * wide, a[1] - 0.25 * wide))
    c = place_of(page, "C")
    pull(page, c, (place_of(page, "B")[0] + 0.1 * wide, c[1] - 0.3 * wide))
    place_of(page, "D")
    pull(page, place_of(page, "B"), place_of(page, "D"))
    until(page, "document.getElementById('board').board.editor.text.includes('[links.3]')")
    until(page, "document.querySelector('.count').textContent.startsWith('F = 3·3 − 2·4 − 0 = 1')")
    page.click("[data-tool=drive]")
    ends = place_of(page, "A"), place_of(page, "C")
    page.mouse.click(*(sum(x) / 2 for x in zip(*ends, strict=True)))
    agrees(page)
    page.check(".wishes [data-figure=sheet]")
    page.wait_for_selector(".figure[data-figure=sheet] svg")
    assert graphkin.check(tomllib.loads(text_of(page))).ok


def test_a_four_bar_is_built_by_keys_alone(page) -> None:
    page.focus("[data-new=empty]")
    page.keyboard.press("Enter")
    page.wait_for_selector(".sketch")

    def piece(tool: str, **values: str) -> None:
        before = text_of(page)
        page.focus(f"[data-tool={tool}]")
        page.keyboard.press("Enter")
        for name, value in values.items():
            field = page.locator(f".piece [name='{name}']")
            if field.evaluate("one => one.tagName") == "SELECT":
                field.select_option(value)
            else:
                field.fill(value)
        page.focus(".piece button[type=submit]")
        page.keyboard.press("Enter")
        until(page, "before => document.getElementById('board').board.editor.text !== before", arg=before)
        page.wait_for_timeout(150)

    piece("pivot", x="0", y="0")
    piece("pivot", x="100", y="0")
    piece("bar", **{"from": "A", "to": "", "tox": "20", "toy": "30"})
    piece("bar", **{"from": "C", "to": "", "tox": "110", "toy": "80"})
    piece("bar", **{"from": "B", "to": "D"})
    piece("drive", link="1")
    agrees(page)
    links = tomllib.loads(text_of(page))["links"]
    assert {"1": ["A", "C"], "2": ["C", "D"], "3": ["B", "D"]} == {name: link["points"] for name, link in links.items()}


def type_at_the_top(page, words: str) -> None:
    page.click(".cm-content")
    page.keyboard.press("Control+Home")
    page.keyboard.type(words)


def test_nothing_is_lost_when_the_page_is_loaded_again_beside_another_tab(page, url) -> None:
    open_scene(page)
    type_at_the_top(page, "# mine\n")
    page.wait_for_timeout(300)
    other = page.context.new_page()
    other.goto(url)
    until(other, "document.getElementById('board').board?.editor.text.startsWith('# mine')")
    type_at_the_top(other, "# other\n")
    other.close()
    page.reload()
    page.wait_for_selector("[data-figure=velocity] svg")
    assert text_of(page).startswith("# mine\n")


def test_tab_leaves_the_text_as_it_is(page) -> None:
    open_scene(page)
    page.click(".cm-content")
    page.keyboard.press("Tab")
    assert not page.evaluate("document.querySelector('.cm-content').contains(document.activeElement)")
    assert library_text("sixbar-420rpm") == text_of(page)


@pytest.mark.parametrize("width", [360, 1024, 1920])
def test_nothing_stands_beside_the_screen(page, width: int) -> None:
    page.set_viewport_size({"width": width, "height": 800})
    open_scene(page)
    assert width == page.evaluate("document.documentElement.scrollWidth")


def test_a_step_that_is_shown_stays_so_when_a_figure_is_enlarged(page) -> None:
    open_scene(page)
    page.click("summary:has-text('Steps')")
    page.click("button:has-text('Next')")
    faded = until(page, "document.querySelectorAll('.later').length")
    page.click("button:has-text('Enlarge')")
    assert faded == page.evaluate("document.querySelectorAll('.later').length")


def test_a_value_that_is_not_reached_gives_way_to_that_of_the_figures(page) -> None:
    open_scene(page, "elliptic-trammel")
    page.fill("input[aria-label='Driver value']", "900")
    page.keyboard.press("Enter")
    until(page, "document.querySelector('.told').textContent")
    assert "199.9996" == page.input_value("input[aria-label='Driver value']")


def test_the_form_counts_teeth_and_gives_places_x_and_y(page) -> None:
    open_scene(page, "geared-five-bar")
    page.click("[data-tab=form]")
    names = page.evaluate("[...document.querySelectorAll('.field input')].map(one => one.name)")
    assert {"gears.g.teeth.1", "gears.g.teeth.2", "frame.points.A.x"} <= {*names}


def test_the_driver_turns_by_slider_number_and_playing(page) -> None:
    open_scene(page)
    page.fill("input[aria-label='Driver value']", "120")
    page.keyboard.press("Enter")
    until(page, "Math.abs(document.getElementById('board').board.state.at?.['1'] - 120) < 1e-9")
    page.click("button:has-text('Play')")
    until(page, "document.getElementById('board').board.state.at['1'] > 125")
    page.click("button:has-text('Stop')")
    agrees(page)


def test_a_slider_brought_back_to_where_it_was_taken_leaves_the_whole_figures(page) -> None:
    open_scene(page)
    page.wait_for_selector("[data-point=B]")
    slider, box = page.locator("[data-driver]"), page.locator("[data-driver]").bounding_box()
    taken = float(slider.input_value())
    thumb = 16.0
    start = box["x"] + thumb / 2 + (box["width"] - thumb) * taken / 360, box["y"] + box["height"] / 2
    pull(page, start, (start[0] + box["width"] / 5, start[1]), let_go=False)
    until(page, "!document.querySelector('[data-point=B]')")  # drawn in motion
    for quarter in range(-16, 17):  # to the very value: at another one the browser says that it has changed
        page.mouse.move(start[0] + quarter / 4, start[1])
        if float(slider.input_value()) == taken:
            break
    assert taken == float(slider.input_value())
    page.mouse.up()
    page.wait_for_selector("[data-point=B]")


def test_a_crank_that_turns_clockwise_is_played_clockwise(page) -> None:
    open_scene(page, "clockwise.toml")
    page.click("button:has-text('Play')")
    until(page, "document.getElementById('board').board.state.at?.['1'] < 40")  # from 45
    page.click("button:has-text('Stop')")
    agrees(page)


def test_what_is_wrong_is_said_in_chinese_on_a_chinese_page(page) -> None:
    open_scene(page)
    page.select_option("select >> nth=0", "zh")
    page.wait_for_selector("button:has-text('撤销')")
    page.wait_for_selector("[data-figure=velocity] svg")
    page.click(".cm-line:has-text('length = 0.34')")
    page.keyboard.press("End")
    page.keyboard.type("-")
    told = page.wait_for_selector(".problems li:has-text('第 20 行：')")
    assert 1 == told.inner_text().count("第 20 行")
    for _ in "0.34-":
        page.keyboard.press("Backspace")
    page.keyboard.type("-3")
    page.wait_for_selector(".problems li:has-text('第 20 行：links.2.length：读到 -3，长度为负；长度应为正')")


def test_the_page_speaks_chinese_and_keeps_the_scene(page) -> None:
    open_scene(page)
    page.select_option("select >> nth=0", "zh")
    page.wait_for_selector("button:has-text('撤销')")
    page.wait_for_selector("[data-figure=velocity] svg")
    assert library_text("sixbar-420rpm") == text_of(page)
    assert "zh" == page.evaluate("document.documentElement.lang")


def test_what_is_written_in_another_language_of_the_page_is_saved(page) -> None:
    open_scene(page, "clockwise.toml")
    type_at_the_top(page, "# one\n")
    page.select_option("select >> nth=0", "zh")
    page.wait_for_selector("button:has-text('撤销')")
    type_at_the_top(page, "# two\n")
    page.evaluate("document.activeElement.blur()")
    page.once("dialog", lambda asked: asked.accept())
    mark = page.evaluate("(() => { const { state } = document.getElementById('board').board; "
                         "const mark = state.mark; state.mark = 'another'; return mark; })()")
    page.wait_for_selector(".agrees")
    page.keyboard.press("Control+s")
    page.wait_for_selector(".told:has-text('clockwise.toml：打开之后已被别人改动')")
    page.evaluate("mark => { document.getElementById('board').board.state.mark = mark }", mark)
    page.keyboard.press("Control+s")
    page.wait_for_selector("header button:has-text('保存'):disabled")
    assert page.query_selector(".agrees") is not None
    assert [] == page.query_selector_all(".problems li")


def test_what_is_said_of_saving_stays_until_the_text_changes(page) -> None:
    open_scene(page, "clockwise.toml")
    type_at_the_top(page, "# saved\n")
    page.once("dialog", lambda asked: asked.accept())
    page.keyboard.press("Control+s")  # before the text typed is drawn
    page.wait_for_selector(".told:has-text('Saved clockwise.toml')")
    page.wait_for_timeout(600)
    assert page.query_selector(".told:has-text('Saved clockwise.toml')")


def test_a_new_scene_stays_when_the_page_speaks_another_language(page) -> None:
    page.click("[data-new=four-bar]")
    new = until(page, "document.getElementById('board').board.editor.text")
    page.select_option("select >> nth=0", "zh")
    page.wait_for_selector("button:has-text('撤销')")
    assert new == until(page, "document.getElementById('board').board.editor.text")


def test_the_page_begins_in_the_language_that_the_command_asks_for(browser, tmp_path) -> None:
    with served("--lang", "zh", "sixbar-420rpm", cwd=tmp_path) as (address, process):
        assert "按 Ctrl-C 结束" == process.stdout.readline().strip()
        one = browser.new_page()
        one.goto(address)
        until(one, "document.documentElement.lang === 'zh'")
        assert "速度多边形" == one.wait_for_selector("[data-figure=velocity] h2").inner_text()
        one.close()
