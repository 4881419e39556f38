"""Words, in each language: one table of sentences for steps, notes and headings.

A phrase is a key with its arguments; the sentence is made where it is shown, in the reader's language.
A third language is one more entry per key.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

__all__ = ["LANGUAGES", "Phrase", "say", "word"]

LANGUAGES = ("en", "zh")


@dataclass(frozen=True)
class Phrase:
    """A sentence to be: its key in the table and what stands in its gaps (names, symbols, numbers, phrases)."""

    key: str
    args: tuple[object, ...] = ()


def say(phrase: Phrase, language: str = "en", show: Callable[[object], str] = str) -> str:
    """The sentence in a language.  ``show`` writes each argument (plain text, or markup of a convention).

    >>> say(Phrase("points", ("2", "B, C")))
    'mark B, C on link 2'
    """
    parts = (say(a, language, show) if isinstance(a, Phrase) else show(a) for a in phrase.args)
    return _TABLE[phrase.key][LANGUAGES.index(language)].format(*parts)


def word(key: str, language: str = "en") -> str:
    """A heading or a term in a language."""
    return _TABLE[key][LANGUAGES.index(language)]


_TABLE: dict[str, tuple[str, str]] = {
    # position
    "frame": ("mark the fixed points and guides of frame {0}: {1}", "画出机架 {0} 的固定点和导路：{1}"),
    "lay off angle": ("draw link {0} about {2} at {1} degrees", "过 {2} 作构件 {0}，与 x 轴成 {1}°"),
    "lay off travel": ("lay off the travel of {0}, {1} mm on paper", "量取移动副 {0} 的位移，图上 {1} mm"),
    "arcs": (
        "an arc about {0} of {3} mm and one about {1} of {4} mm meet in {2}",
        "以 {0} 为圆心、{3} mm 为半径作弧，以 {1} 为圆心、{4} mm 为半径作弧，交于 {2}",
    ),
    "path": ("draw the line on which {0} moves, along the guide of {1}", "作 {0} 的轨迹线，平行于移动副 {1} 的导路"),
    "arc on path": ("an arc about {0} of {2} mm cuts it in {1}", "以 {0} 为圆心、{2} mm 为半径作弧，交该线于 {1}"),
    "line of guide": ("join {0} and {1}: the guide of {2} lies along it", "连接 {0}、{1}，即移动副 {2} 的导路方向"),
    "tangent": (
        "circle of {2} mm about {0}, circle over {0}{1} as diameter; their crossing and {1} give the guide of {3}",
        "以 {0} 为圆心、{2} mm 为半径作圆，再以 {0}{1} 为直径作圆，其交点与 {1} 的连线即移动副 {3} 的导路方向",
    ),
    "paths": (
        "{0} lies where its lines along the guides of {1} and {2} cross",
        "作 {0} 沿移动副 {1} 和 {2} 导路的轨迹线，交点即 {0}",
    ),
    "slide to meet": (
        "shift along the guide of {1} until {0} lies on the guide of {2}",
        "沿移动副 {1} 的导路平移，使 {0} 落在移动副 {2} 的导路上",
    ),
    "points": ("mark {1} on link {0}", "在构件 {0} 上标出 {1}"),
    "transfer": ("transfer {1} of link {0} with the compass", "用圆规在构件 {0} 上定出 {1}"),
    # polygons
    "lay off": ("lay off {0} = {1}, {2} mm, {3}", "量取 {0} = {1}，{2} mm，方向 {3}"),
    "lay off normal": (
        "lay off the normal component {0} = {1}, {2} mm, {3}",
        "量取法向加速度 {0} = {1}，{2} mm，方向 {3}",
    ),
    "lay off coriolis": (
        "lay off the Coriolis component {0} = {1}, {2} mm, {3}",
        "量取哥氏加速度 {0} = {1}，{2} mm，方向 {3}",
    ),
    "carry": ("add {0}, whose size and direction are known", "先加上大小、方向均已知的 {0}"),
    "direction": ("through its start, {1}: the direction of {0}", "过起点作 {1}，即 {0} 的方向线"),
    "meet": ("the two lines meet in the end point of {0}", "两方向线交于 {0} 的矢量端点"),
    "found": ("so {0} is found, {1} mm", "得 {0}，图上长 {1} mm"),
    "put back": ("put {0} in its place in the chain", "将 {0} 移回矢量链中的位置"),
    "resultant": ("draw {0} from the pole", "由极点作 {0}"),
    "name": ("name the end point of {0}", "标出 {0} 的矢量端点"),
    "omega ccw": (
        "ω_{{{0}}} = {1} / {2} = {3} rad/s, counter-clockwise",
        "ω_{{{0}}} = {1} / {2} = {3} rad/s，逆时针",
    ),
    "omega cw": ("ω_{{{0}}} = {1} / {2} = {3} rad/s, clockwise", "ω_{{{0}}} = {1} / {2} = {3} rad/s，顺时针"),
    "alpha ccw": (
        "α_{{{0}}} = {1} / {2} = {3} rad/s², counter-clockwise",
        "α_{{{0}}} = {1} / {2} = {3} rad/s²，逆时针",
    ),
    "alpha cw": ("α_{{{0}}} = {1} / {2} = {3} rad/s², clockwise", "α_{{{0}}} = {1} / {2} = {3} rad/s²，顺时针"),
    "translates": ("link {0} translates: all its points move alike", "构件 {0} 作平动，各点运动相同"),
    "same place": ("{0} moves with {1}", "{0} 与 {1} 运动相同"),
    "by rate": ("{0} from {1} by the rates of link {2}", "由 {1} 及构件 {2} 的角速度、角加速度求 {0}"),
    "division": (
        "{0} divides the image of link {3} as it divides {1}{2} on the link",
        "按构件 {3} 上的比例分割 {1}{2} 的影像，得 {0}",
    ),
    "image": (
        "image of link {3}: the triangle over {1}{2} similar to that of the link, turned the same way, gives {0}",
        "构件 {3} 的影像：在 {1}{2} 上作与构件相似且字母绕行方向一致的三角形，得 {0}",
    ),
    "asked": ("draw {0}, which is asked for", "作出所求的 {0}"),
    "placing": ("placing link {0} on paper", "画出构件 {0} 的位置"),
    "reading": ("reading {0} off the paper", "从图上量取 {0}"),
    # remarks
    "advice": (
        "The least certain reading is {0} (±{1} %), mostly from {2} ({3} % of the variance); {4} drawn twice as "
        "large would leave ±{5} %.",
        "最不可靠的量取值是 {0}（±{1} %），主要来自：{2}（占方差 {3} %）；将{4}放大一倍，可减小到 ±{5} %。",
    ),
    "figure length": ("the mechanism", "机构图"),
    "figure velocity": ("the velocity polygon", "速度多边形"),
    "figure acceleration": ("the acceleration polygon", "加速度多边形"),
    "short arm": (
        "links {0}: {1} lies only {2} mm from {3} on paper; the direction of the guide is uncertain",
        "构件 {0}：图上 {1} 距 {3} 仅 {2} mm，导路方向不确定",
    ),
    "sharp crossing": (
        "the lines that find {0} cross at {1} degrees only: readings that depend on it are uncertain",
        "求 {0} 的两线夹角仅 {1}°，与之有关的量取值误差大",
    ),
    "zero vector": ("{0} = 0", "{0} = 0"),
    "off the sheet": (
        "the lines that find {0} meet off the sheet; the crossing was computed from their directions",
        "求 {0} 的两直线交于图纸之外，交点按其方向算出",
    ),
    "stopped": (
        "the group of links {0} is of class {1}: it has no two lines that find a point, so compass and ruler stop "
        "here; graphkin solve gives its motion",
        "构件 {0} 组成 {1} 级杆组，无法由两条线直接求点，图解到此为止；其运动可用 graphkin solve 求得",
    ),
    # assemblies
    "RRR 0": ("{1} to the left of the line from {0} to {2}", "{1} 在 {0} 到 {2} 连线的左侧"),
    "RRR 1": ("{1} to the right of the line from {0} to {2}", "{1} 在 {0} 到 {2} 连线的右侧"),
    "RRP 0": ("{1} further along the guide of {2}", "{1} 取 {2} 导路正向较远的一侧"),
    "RRP 1": ("{1} further back on the guide of {2}", "{1} 取 {2} 导路反向较远的一侧"),
    "RPR 0": ("{0} on the positive side of the guide of {1}", "{0} 在 {1} 导路的正侧"),
    "RPR 1": ("{0} on the negative side of the guide of {1}", "{0} 在 {1} 导路的负侧"),
    "one assembly": ("only one assembly", "只有一种装配方式"),
    # centres
    "centre joint": ("{0} lies in the turning pair {1}", "{0} 位于转动副 {1} 处"),
    "centre guide": ("{0} lies at infinity, square to the guide of {1}", "{0} 位于垂直于移动副 {1} 导路方向的无穷远处"),
    "centre crossing": ("{0} lies where {1} and {2} cross", "{0} 为 {1} 与 {2} 的交点"),
    "centre crossing far": (
        "{0} lies at infinity: {1} and {2} are parallel",
        "{1} 与 {2} 平行，{0} 在其方向的无穷远处",
    ),
    "centre velocity polygon": (
        "{0} from the measured velocity polygon: the point of both links that has one velocity",
        "由速度多边形量取两构件的速度，其同速重合点即 {0}",
    ),
    "centre superposition": (
        "{0} from two auxiliary motions superposed, so that the length of {1} is kept",
        "由两组试设运动叠加（使 {1} 的长度保持不变）求得 {0}",
    ),
    "centre superposition driver": (
        "{0} from two auxiliary motions superposed, so that the driver {1} has its speed",
        "由两组试设运动叠加（使原动件 {1} 的速度为给定值）求得 {0}",
    ),
    "centre none": ("{0} is not determined", "{0} 无法确定"),
    "centre no motion": (
        "links {0} and {1} do not move relative to each other here",
        "构件 {0} 与 {1} 在此位置无相对运动",
    ),
    "centre few lines": (
        "Kennedy's theorem gives too few lines for links {0} and {1} ({2} of 2): the linkage is indeterminate",
        "三心定理对构件 {0} 与 {1} 只能给出 {2} 条直线（需 2 条）：该机构的瞬心无法由三心定理直接求得",
    ),
    "centre lines together": (
        "all lines of Kennedy's theorem for links {0} and {1} fall together here",
        "在此位置，三心定理对构件 {0} 与 {1} 给出的各直线重合",
    ),
    "centre same sense": (
        "ω_{{{0}}} = ω_{{{1}}} · {2}{3} / {2}{4} = ω_{{{1}}} · {5} / {6} = {7} rad/s; "
        "{3} and {4} lie on one side of {2}: the same sense",
        "ω_{{{0}}} = ω_{{{1}}} · {2}{3} / {2}{4} = ω_{{{1}}} · {5} / {6} = {7} rad/s；{3}、{4} 在 {2} 同侧，转向相同",
    ),
    "centre opposite sense": (
        "ω_{{{0}}} = ω_{{{1}}} · {2}{3} / {2}{4} = ω_{{{1}}} · {5} / {6} = {7} rad/s; "
        "{3} and {4} lie on both sides of {2}: the opposite sense",
        "ω_{{{0}}} = ω_{{{1}}} · {2}{3} / {2}{4} = ω_{{{1}}} · {5} / {6} = {7} rad/s；{3}、{4} 在 {2} 两侧，转向相反",
    ),
    "centre slides": (
        "link {0} translates with the velocity that link {1} has at {2}",
        "构件 {0} 平动，其速度等于构件 {1} 在 {2} 处的速度",
    ),
    "centre turns alike": ("{2} lies at infinity: ω_{{{0}}} = ω_{{{1}}}", "{2} 在无穷远处：ω_{{{0}}} = ω_{{{1}}}"),
    "centre from slider": (
        "link {0} has at {2} the velocity of link {1}: ω_{{{0}}} = v / {2}{4} = v / {5} mm = {6} rad/s",
        "构件 {0} 在 {2} 处的速度等于构件 {1} 的速度：ω_{{{0}}} = v / {2}{4} = v / {5} mm = {6} rad/s",
    ),
    "centres": ("Instant centres", "速度瞬心"),
    "centre": ("centre", "瞬心"),
    "place": ("place", "位置"),
    "how found": ("how found", "求法"),
    "way velocity polygon": ("velocity polygon", "速度多边形"),
    "way superposition": ("superposition", "运动叠加法"),
    "way none": ("not determined", "无法确定"),
    "centres checked": (
        "All {0} instant centres agree with the analytic solution.",
        "{0} 个速度瞬心均与解析解一致。",
    ),
    "circle diagram": ("circle diagram", "瞬心圆图"),
    "velocities by centres": ("Velocities by centres", "瞬心法求速度"),
    "permanent fixed": ("permanent, fixed", "绝对瞬心（固定）"),
    "permanent moving": ("permanent, moving", "相对瞬心（运动副处）"),
    "by Kennedy": ("found by Kennedy's theorem", "由三心定理求得"),
    "otherwise": ("found in another way", "以其他方法求得"),
    "fixed centrode": ("fixed centrode", "定瞬心线"),
    "moving centrode": ("moving centrode", "动瞬心线"),
    "coupler curve": ("coupler curve of {0}", "{0} 点的连杆曲线"),
    "centrodes": ("Centrodes of link", "瞬心线，构件"),
    # headings of the report
    "source": ("Source", "来源"),
    "driver": ("Driver", "原动件"),
    "group": ("Group of links", "杆组"),
    "steps": ("Steps", "作图步骤"),
    "equations": ("Vector equations", "矢量方程"),
    "readings": ("Readings and check", "量取结果与校核"),
    "quantity": ("quantity", "量"),
    "on paper": ("mm on paper", "图上 mm"),
    "measured": ("measured", "图解值"),
    "exact": ("exact", "解析值"),
    "size": ("size", "大小"),
    "direction of": ("direction", "方向"),
    "check passed": ("All {0} readings agree with the analytic solution.", "{0} 个量取值均与解析解一致。"),
    "check failed": ("Out of tolerance: {0}.", "超出允许误差：{0}。"),
    "nothing checked": ("Nothing of it is drawn, so nothing is checked.", "未能作图，无可校核。"),
    # tables of the solution
    "heads of links": (
        "link|angle (deg)|omega (rad/s)|alpha (rad/s2)",
        "构件|转角 (°)|角速度 (rad/s)|角加速度 (rad/s²)",
    ),
    "heads of points": (
        "point|x, y ({0})|velocity ({0}/s)|acceleration ({0}/s2)",
        "点|x, y ({0})|速度 ({0}/s)|加速度 ({0}/s²)",
    ),
    "heads of slides": (
        "slide|travel ({0})|velocity ({0}/s)|acceleration ({0}/s2)|Coriolis",
        "移动副|位移 ({0})|速度 ({0}/s)|加速度 ({0}/s²)|哥氏加速度",
    ),
    # figures
    "mechanism": ("Mechanism", "机构运动简图"),
    "velocity polygon": ("Velocity polygon", "速度多边形"),
    "acceleration polygon": ("Acceleration polygon", "加速度多边形"),
    "sheet": ("Drawing sheet", "图解"),
    "given": ("Given", "已知"),
    "scale": ("Scale", "比例尺"),
    "scales": ("Scales", "比例尺"),
    "check bar": ("50 mm, to check the print", "50 mm，核对打印比例"),
    "title": ("Title", "名称"),
    "difference": ("difference", "相对误差"),
    "lengths": ("Lengths", "尺寸"),
    "unit": ("unit", "单位"),
    "guide": ("guide", "导路"),
    "sense of Coriolis": (
        "Sense of the Coriolis part: the sliding velocity turned by 90° with the guide",
        "哥氏加速度方向：相对速度沿导杆 ω 转向转过 90°",
    ),
    "more readings": ("{0} more in readings.csv", "其余 {0} 项见 readings.csv"),
    "more equations": ("{0} more in the steps", "其余 {0} 个方程见作图步骤"),
    "stopped here": ("drawn as far as compass and ruler reach", "图解所及部分"),
    "detail": ("Detail {0} : 1", "放大图 {0} : 1"),
    "all agree": ("all {0} readings agree with the analytic solution", "{0} 个读数均与解析解一致"),
    "not all agree": ("{0} of {1} readings out of tolerance", "{1} 个读数中 {0} 个超出允差"),
    "instrument": ("Instrument", "作图工具"),
    # vectors in words
    "v of": ("velocity of {0}", "{0} 的速度"),
    "a of": ("acceleration of {0}", "{0} 的加速度"),
    "an of": ("normal acceleration of {0}", "{0} 的法向加速度"),
    "at of": ("tangential acceleration of {0}", "{0} 的切向加速度"),
    "ak of": ("Coriolis acceleration of {0}", "{0} 的哥氏加速度"),
    "ar of": ("sliding acceleration of {0}", "{0} 的相对滑动加速度"),
    "relative to": (" relative to {0}", "（相对 {0}）"),
    "point of link": ("{0} of link {1}", "构件 {1} 上的 {0}"),
    # handouts
    "problem sheet": ("Problem sheet", "作业题"),
    "worked solution": ("Worked solution", "作图解答"),
    "answer key": ("Answer key", "参考答案"),
    "problem": ("Problem", "题目"),
    "name of student": ("Name", "姓名"),
    "class of student": ("Class, number", "班级、学号"),
    "date": ("Date", "日期"),
    "page of": ("page {0} of {1}", "第 {0} 页，共 {1} 页"),
    "solve here": (
        "Solve graphically on this sheet, with ruler, set squares and compass. The mechanism is drawn to scale.",
        "请用直尺、三角板和圆规在本页上图解。机构简图已按比例画出。",
    ),
    "print true": (
        "Print at 100 %: the bar on each figure is 50 mm long.",
        "请按 100% 打印：各图上的标尺长 50 mm。",
    ),
    "find": ("Find", "求"),
    "lengths given": ("Lengths", "各构件尺寸"),
    "fixed points": ("Fixed points", "固定铰链点坐标"),
    "guide at": ("guide {0} through ({1}, {2}) {3} at {4}°", "导路 {0} 过点 ({1}, {2}) {3}，与 x 轴成 {4}°"),
    "guides": ("Guides", "导路"),
    "your equations": ("Vector equations with what is known of sizes and directions", "列矢量方程，标明大小、方向"),
    "your polygon": ("Draw from the pole {0}.", "以极点 {0} 为起点作图。"),
    "your results": ("Results", "结果"),
    "value": ("value", "数值"),
    "sense": ("sense or direction", "转向或方向"),
    "the position": ("Position", "机构位置图"),
    "equation numbered": ("Equation {0}", "方程 {0}"),
    "for velocity": ("velocity", "速度"),
    "for acceleration": ("acceleration", "加速度"),
    "further vectors": ("Further vectors asked for", "其他所求矢量"),
    "figure so far": (
        "{0}, as far as step {1}; steps {2} to {1} are on a light band",
        "{0}，作至第 {1} 步；第 {2} 至 {1} 步以浅色带标出",
    ),
    "figure whole": ("{0}, step {1}", "{0}，第 {1} 步"),
    "results": ("Results", "结果"),
    "check": ("Check", "校核"),
    "check words": (
        "Readings against the analytic solution, which the drawing does not use.",
        "量取值与解析解比较；作图过程不使用解析解。",
    ),
    "remarks": ("Remarks", "说明"),
    "tolerance": ("tolerance", "允差"),
    "accept": ("accept", "可接受范围"),
    "direction deg": ("direction (°)", "方向角 (°)"),
    "counter-clockwise": ("counter-clockwise", "逆时针"),
    "clockwise": ("clockwise", "顺时针"),
    "key words": (
        "Tolerances are three standard deviations of a pencil drawing at these scales, predicted from the construction "
        "(points {0} mm, ruler {1} mm, compass {2} mm, directions {3}°). Quantities asked for are in bold.",
        "允差为按上述比例尺铅笔作图时预计标准差的三倍，由作图过程推算"
        "（点 {0} mm，直尺 {1} mm，圆规 {2} mm，方向 {3}°）。所求各量用粗体表示。",
    ),
    "not promised": ("–", "–"),
    # pages of a handout on screen
    "step of": ("Step {0} of {1}", "第 {0} 步，共 {1} 步"),
    "step slider": ("Step", "步骤"),
    "position slider": ("Position of the driver", "原动件位置"),
    "positions words": (
        "Figures and steps are drawn for {0} positions of the driver.",
        "共给出原动件的 {0} 个位置。",
    ),
    "first step": ("First step", "第一步"),
    "previous step": ("Previous step", "上一步"),
    "next step": ("Next step", "下一步"),
    "last step": ("Last step", "最后一步"),
    "next equation": ("Next equation", "下一方程"),
    "keys": (
        "Keys: ← → steps, Home and End, Page Up and Page Down (or [ and ]) equations.",
        "按键：← → 逐步，Home、End 首末步，Page Up、Page Down（或 [ ]）切换方程。",
    ),
    "step by step": ("Step by step", "逐步作图"),
    "print hint": ("Printing this page gives the worked solution on A4.", "打印本页即得 A4 解答。"),
    "the figures": ("Figures", "图"),
    "own position": ("the given position", "题给位置"),
    "no pdf extra": (
        "Typeset PDF needs the extra pdf (pip install \"graphkin[pdf]\"); the figure sheets were written instead.",
        "排版 PDF 需要附加包 pdf（pip install \"graphkin[pdf]\"）；现以图页代替。",
    ),
    # descriptions for those who do not see the figure
    "link joins": ("Link {0} joins {1}.", "构件 {0} 连接 {1}。"),
    "fixed link": ("The fixed link {0} has the points {1}.", "机架 {0} 上有点 {1}。"),
    "link slides": ("Link {0} slides on link {1}.", "构件 {0} 在构件 {1} 上滑动。"),
    "pin runs": ("Point {0} of link {1} runs in a slot of link {2}.", "构件 {1} 上的点 {0} 在构件 {2} 的槽中运动。"),
    "point lies": ("{0} lies at ({1}, {2}) {3}.", "{0} 位于 ({1}, {2}) {3}。"),
    "vector is": (
        "{0} is {1} {2}, {3} mm on paper, at {4} degrees.",
        "{0} = {1} {2}，图上 {3} mm，方向角 {4}°。",
    ),
    "vector is zero": ("{0} is zero.", "{0} 为零。"),
    # the whole turn
    "motion of slide": ("Motion of slider {0}", "滑块 {0} 的运动线图"),
    "motion of link": ("Motion of link {0}", "构件 {0} 的运动线图"),
    "curve of point": ("Coupler curve of {0}", "{0} 点的连杆曲线"),
    "analytic curve": ("analytic", "解析值"),
    "measured dots": ("measured on the drawn polygons", "由图解多边形量得"),
    "greatest": ("maximum", "极大值"),
    "least": ("minimum", "极小值"),
    "of the driver": ("{0}, in the sense of motion →", "{0}，沿运动方向 →"),
    "stroke is": ("stroke {0}", "行程 {0}"),
    "swing is": ("swing {0}", "摆角 {0}"),
    "K is": ("K = {0}", "K = {0}"),
    "limits at": ("limit positions at {0}", "极限位置 {0}"),
    "turns on": ("it turns on and on", "整周转动"),
    "does not move": ("it does not move", "不动"),
    "ticks at": (
        "marks each {0}° of the driver from {1}°, in the sense of motion",
        "自 {1}° 起，沿运动方向每隔 {0}° 标一点",
    ),
    "range": ("Range of the driver", "原动件活动范围"),
    "full turn": ("turns fully", "可整周转动"),
    "turns to close": ("the motion repeats after {0} turns of the driver", "原动件每转 {0} 周，运动重复一次"),
    "also assembles": ("another assembly: {0}", "另一装配范围：{0}"),
    "basic mechanism": ("Mechanism", "基本机构"),
    "turns fully": ("turns fully: {0}", "整转构件：{0}"),
    "output": ("Output", "输出构件"),
    "limit position": ("Limit positions", "极限位置"),
    "stroke": ("stroke", "行程"),
    "least transmission": ("Least transmission angle", "最小传动角"),
    "same everywhere": ("in every position", "任意位置"),
    "greatest pressure": ("greatest pressure angle {0}", "最大压力角 {0}"),
    "curve": ("curve", "曲线"),
    "zero at": ("zero at", "零点位置"),
    "positions solved": ("{0} of {1} positions solved", "{1} 个位置中求得 {0} 个"),
    "designs solved": ("{0} designs: {1}", "{0} 个方案：{1}"),
    # names of basic mechanisms
    "crank-rocker": ("crank-rocker", "曲柄摇杆机构"),
    "double-crank": ("double-crank (drag link)", "双曲柄机构"),
    "double-rocker": ("double-rocker (its coupler turns fully)", "双摇杆机构（连杆可整转）"),
    "triple-rocker": ("triple-rocker (no link turns fully)", "双摇杆机构（无整转副）"),
    "change point": ("change-point four-bar", "变点四杆机构"),
    "in-line slider-crank": ("in-line slider-crank", "对心曲柄滑块机构"),
    "offset slider-crank": ("offset slider-crank", "偏置曲柄滑块机构"),
    "in-line rocker-slider": ("in-line rocker-slider", "对心摇杆滑块机构"),
    "offset rocker-slider": ("offset rocker-slider", "偏置摇杆滑块机构"),
    "in-line slider-crank at a change point": ("in-line slider-crank at a change point", "对心曲柄滑块机构（变点）"),
    "offset slider-crank at a change point": ("offset slider-crank at a change point", "偏置曲柄滑块机构（变点）"),
    "in-line slider-crank whose rod turns fully": (
        "in-line slider-crank whose rod turns fully",
        "对心摇杆滑块机构（连杆整转）",
    ),
    "offset slider-crank whose rod turns fully": (
        "offset slider-crank whose rod turns fully",
        "偏置摇杆滑块机构（连杆整转）",
    ),
    "swinging guide bar": ("swinging guide bar", "摆动导杆机构"),
    "rotating guide bar (Whitworth)": ("rotating guide bar (Whitworth)", "转动导杆机构"),
    "guide bar at a change point": ("guide bar at a change point", "导杆机构（变点）"),
    "guide bar without a full turn": ("guide bar without a full turn", "无整转构件的导杆机构"),
    "oscillating block": ("oscillating block", "曲柄摇块机构"),
    "rotating block": ("rotating block", "转块机构"),
    "block at a change point": ("block at a change point", "摇块机构（变点）"),
    "block without a full turn": ("block without a full turn", "无整转构件的摇块机构"),
    "Scotch yoke": ("Scotch yoke", "正弦机构"),
    # what a wrong value looks like
    "slip sign": ("sign", "正负号错误"),
    "slip factor": ("wrong unit: {0} times the right value", "单位错误：为正确值的 {0} 倍"),
    "slip rpm": ("wrong unit: r/min and rad/s confused", "单位错误：r/min 与 rad/s 混淆"),
    "slip degrees": ("wrong unit: degrees and radians confused", "单位错误：度与弧度混淆"),
    "slip double": ("twice the right value (diameter for radius)", "为正确值的两倍（直径当作半径）"),
    "slip half": ("half the right value (radius for diameter)", "为正确值的一半（半径当作直径）"),
    "slip coriolis left out": ("Coriolis left out ({0})", "漏掉哥氏加速度（{0}）"),
    "slip coriolis reversed": ("Coriolis reversed ({0})", "哥氏加速度方向相反（{0}）"),
    "slip coriolis factor": ("Coriolis without its factor 2 ({0})", "哥氏加速度漏乘 2（{0}）"),
    "slip normal left out": ("normal term left out ({0})", "漏掉法向加速度（{0}）"),
    "slip normal reversed": ("normal term reversed ({0})", "法向加速度方向相反（{0}）"),
    "slip normal only": ("normal term only ({0})", "只计法向分量（{0}）"),
    "slip tangential only": ("tangential term only ({0})", "只计切向分量（{0}）"),
    "slip coriolis only": ("Coriolis term only ({0})", "只计哥氏分量（{0}）"),
    "slip sliding only": ("sliding term only ({0})", "只计相对滑动分量（{0}）"),
    "slip assembly": ("other assembly", "装配形式取错"),
    "slip velocity scale": ("velocity scale used for acceleration", "加速度误用了速度比例尺"),
    "slip acceleration scale": ("acceleration scale used for velocity", "速度误用了加速度比例尺"),
    "slip millimetres": ("millimetres on paper instead of the value", "写成了图上毫米数"),
    "slip relative": ("a relative vector for the absolute one: {0}", "把相对矢量当作绝对矢量：{0}"),
    "slip other": ("the value of another quantity: {0}", "是另一个量的值：{0}"),
    "slip component": ("the {0} component of {1} only", "只是 {1} 的 {0} 分量"),
    "slip other component": ("another column: the {0} component of {1}", "另一栏的值：{1} 的 {0} 分量"),
    "slip and sign": ("{0}, and the sign", "{0}，且正负号错误"),
    "slip position": ("another position: the value at {0}", "是另一位置的值：{0}"),
    "slip pen": ("a slip of the pen for {0}", "{0} 的笔误"),
    "slip follows": ("follows from an earlier wrong value: {0}", "由前面的错误值引起：{0}"),
    "right": ("right", "正确"),
    "within drafting accuracy": ("within drafting accuracy", "在作图误差之内"),
    "wrong": ("wrong", "错误"),
    "printed": ("printed", "给出值"),
    "deviation": ("deviation", "相对误差"),
    "verdict": ("verdict", "评判"),
    "looks like": ("looks like", "疑似原因"),
    "person": ("person", "姓名"),
    # where methods fail
    "stability title": ("Where methods fail, and how fast", "各种方法在何处失效，失效得多快"),
    "stability facts": (
        "error against the distance from the singular position; numbers on the curves: fitted slope (theory)",
        "误差与到奇异位置距离的关系；曲线旁数字：拟合斜率（理论值）",
    ),
    "relative error": ("error", "误差"),
    "dead point RRR": ("Dead point of RRR: rod and rocker come into line", "RRR 杆组的死点：连杆与摇杆趋于共线"),
    "dead point RRP": ("Dead point of RRP: the rod stands square to the guide", "RRP 杆组的死点：连杆趋于垂直导路"),
    "dead point RPR": ("Dead point of RPR: the guide stands square to BC", "RPR 杆组的死点：导路趋于垂直 BC"),
    "crossing height": ("Height at which two arcs cross", "两圆弧交点的高度"),
    "angle near zero": ("An angle near 0° (180° alike)", "接近 0°（或 180°）的角"),
    "differences": ("Rates by differences of places", "由位置差分求速度和加速度"),
    "parallel lines": ("Instant centre of nearly parallel lines", "近似平行线所交的瞬心"),
    "near ground": ("Guide bar: crank nearly as long as the ground", "导杆机构：曲柄长度接近机架长度"),
    "guide flip": ("Guide bar: crank as long as the ground", "导杆机构：曲柄与机架等长"),
    "slow sliding": ("Sliding that nearly stops", "接近停止的相对滑动"),
    "small scale": ("A pencil drawing made small", "图画得小"),
    "crank before": ("crank before the dead point (rad)", "曲柄到死点的角度（rad）"),
    "gap of radii": ("gap of the radii, 1 − c/(r + s)", "两半径之和的余量 1 − c/(r + s)"),
    "angle of two lines": ("angle of the two lines (rad)", "两线夹角（rad）"),
    "step": ("step (rad of the crank)", "步长（曲柄转角 rad）"),
    "crank from ground": ("1 − crank/ground, pin as near to the pivot", "1 − 曲柄/机架，销距支点同量级"),
    "crank from flip": ("crank from the flip (rad)", "曲柄到翻转位置的角度（rad）"),
    "crank from line": ("crank from the line of centres (rad)", "曲柄到连心线的角度（rad）"),
    "crank on paper": ("crank on paper (mm)", "图上曲柄长（mm）"),
    "place closed form": ("place", "位置"),
    "velocity closed form": ("velocity", "速度"),
    "acceleration closed form": ("acceleration", "加速度"),
    "velocity Newton": ("velocity, Newton", "速度，牛顿法"),
    "all from the dead point": ("all, distance given", "全部，给定到死点的距离"),
    "velocity exact drawing": ("velocity, exact drawing", "速度，精确作图"),
    "velocity pencil": ("velocity, pencil", "速度，铅笔"),
    "height by squares": ("$c^2 − m^2$", "$c^2 − m^2$"),
    "height by Heron": ("Heron's product", "海伦乘积"),
    "angle by arccos": ("arccos", "arccos"),
    "angle by atan2": ("atan2", "atan2"),
    "velocity differences": ("velocity", "速度"),
    "acceleration differences": ("acceleration", "加速度"),
    "velocity complex step": ("velocity, complex step", "速度，复数步长"),
    "centre place": ("place", "位置"),
    "centre velocity": ("velocity through it", "由其求得的速度"),
    "centre place pencil": ("place, pencil", "位置，铅笔"),
    "centre velocity pencil": ("velocity through it, pencil", "由其求得的速度，铅笔"),
    "place bar": ("direction of the bar", "导杆方向"),
    "acceleration Coriolis": ("Coriolis", "哥氏加速度"),
    "acceleration bar": ("α of the bar", "导杆 α"),
    "acceleration bar solved": ("α, solve in 50 digits", "α，50 位求解"),
    "acceleration bar drawn": ("α, exact drawing", "α，精确作图"),
    "velocity sliding": ("sliding velocity", "滑动速度"),
    "velocity bar": ("ω of the bar", "导杆 ω"),
    "velocity sliding pencil": ("sliding velocity, pencil", "滑动速度，铅笔"),
    "velocity bar pencil": ("ω of the bar, pencil", "导杆 ω，铅笔"),
    "pencil points": ("points only", "仅点位误差"),
    "pencil all": ("all tools", "全部工具"),
    "size Coriolis": ("Coriolis itself", "哥氏加速度本身"),
    "size bar": ("α of the bar itself", "导杆 α 本身"),
    "newton marks": ("Newton's method", "牛顿法"),
    "drawing marks": ("exact drawing", "精确作图"),
    "pencil marks": ("pencil (predicted or drawn)", "铅笔（预测或作图）"),
    "stop marks": ("last answer before it refuses by name", "指名拒绝之前的最后一个结果"),
    "fate dead closed": (
        "solve refuses from {0} down (dead point), before that it states its error bound.",
        "solve 自 {0} 起拒绝（死点），此前给出误差界。",
    ),
    "fate dead newton": (
        "Newton never meets its stop below {0}, and says nothing.", "牛顿法在 {0} 以下达不到收敛判据，且不作提示。"
    ),
    "fate dead drawn": (
        "The board warns under 15° of crossing; the pencil's arcs miss each other from {0} down.",
        "交角小于 15° 时作图给出警告；自 {0} 起铅笔弧线不再相交。",
    ),
    "fate height": (
        "c² − m² goes on to the end without a sign that it is lost.", "c² − m² 直到最后都不显示已失去精度。"
    ),
    "fate arccos": (
        "arccos gives 0 or 1.5·$10^{{−8}}$ for every angle below that, and says nothing.",
        "更小的角 arccos 只给出 0 或 1.5·$10^{{−8}}$，且不作提示。",
    ),
    "fate differences": (
        "Never better than some $10^{{−11}}$ and $10^{{−8}}$, and nothing says which step is good.",
        "最好也只有约 $10^{{−11}}$ 和 $10^{{−8}}$，而且无从知道哪个步长合适。",
    ),
    "fate centre": (
        "Beyond $10^{{12}}$ sizes the centre is given as a direction; velocities through it stay.",
        "远于 $10^{{12}}$ 倍尺寸的瞬心以方向给出；由它求得的速度不受影响。",
    ),
    "grows": (
        "The values themselves grow: Coriolis with power {0}, α of the bar with {1}.",
        "量值本身增大：哥氏加速度按 {0} 次幂，导杆 α 按 {1} 次幂。",
    ),
    "fate near ground": ("More digits help: solve takes 50 there.", "增加位数有效：solve 在此用 50 位。"),
    "fate flip": (
        "Below $10^{{−7}}$ solve and the board refuse by name: B on C, the bar has no direction.",
        "$10^{{−7}}$ 以下 solve 和作图均指名拒绝：B 与 C 重合，导杆方向不定。",
    ),
    "fate sliding": (
        "Only the vanishing part is lost; the pencil's uncertainty is printed beside it.",
        "只有趋于零的那部分失去精度；铅笔读数旁印有其不确定度。",
    ),
    "lesson": ("What to take from it", "结论"),
    "lesson place": (
        "At a dead point the input itself is lost: no method and no number of digits helps, unless the distance from "
        "the dead point is what the scene gives (from = \"dead point\").",
        "在死点附近丢失的是输入本身：任何方法、任何位数都无济于事，"
        "除非题目直接给定到死点的距离（from = \"dead point\"）。",
    ),
    "lesson digits": (
        "Elsewhere digits are lost by the formula: choose one without cancelling (Heron, atan2), or more digits.",
        "其他情形是公式丢失了位数：应选无相消的公式（海伦、atan2），或增加位数。",
    ),
    "lesson pencil": (
        "A pencil loses $10^{13}$ times as much by the same laws: what it shows at 0.1 rad, doubles show at "
        "$10^{−14}$.",
        "铅笔按同样的规律损失，只是大 $10^{13}$ 倍：它在 0.1 rad 处的情形，双精度在 $10^{−14}$ 处才出现。",
    ),
    "lesson centres": (
        "A centre that lies too far off to be drawn still gives a good velocity: draw the lines, not the point.",
        "远得画不出的瞬心仍能给出准确的速度：画线即可，不必画点。",
    ),
    "lesson says": (
        "Differences, arccos, c² − m² and Newton's method return a number to the end. Trust what warns and refuses.",
        "差分、arccos、c² − m² 和牛顿法直到最后都给出数值。应信任会警告、会拒绝的方法。",
    ),
    "fate scale": (
        "Points gain with size, set squares do not: beyond a crank of 50 mm nothing is won.",
        "点位误差随图增大而减小，三角板误差不变：曲柄超过 50 mm 再放大无益。",
    ),
    # speed against accuracy
    "speed title": ("Speed against accuracy", "速度与精度"),
    "speed of velocity": ("velocity", "速度分析"),
    "speed of acceleration": ("acceleration", "加速度分析"),
    "cost of a position": ("cost of one position (s)", "一个位置的耗时（s）"),
    "largest error": ("largest error, in parts of the largest value", "最大误差（与最大值之比）"),
    "copying": ("copying the output", "复制输出所需"),
    "closed arrays": ("closed form, arrays", "解析式，数组"),
    "closed floats": ("closed form, one by one", "解析式，逐个位置"),
    "closed single": ("closed form, single precision", "解析式，单精度"),
    "closed compiled": ("closed form, compiled (1 core)", "解析式，编译（单核）"),
    "whole solve": ("graphkin solve, with bounds", "graphkin solve，含误差界"),
    "Newton": ("Newton, number of steps", "牛顿法，迭代次数"),
    "differences of": ("differences, step", "差分，步长"),
    "complex step": ("complex step", "复数步长"),
    "exact drawing": ("exact drawing", "精确作图"),
    "cad drawing": ("read off a CAD screen", "CAD 屏幕读数"),
    "instant centres": ("instant centres", "瞬心法"),
    "pencil": ("pencil, simulated, size", "铅笔（模拟），图幅"),
    "by hand": ("pencil and ruler, by hand, size", "铅笔直尺手工，图幅"),
    "pylinkage": ("pylinkage", "pylinkage"),
    "scipy root": ("scipy.optimize.root", "scipy.optimize.root"),
    "only asked": ("{0}: {1} alone", "{0}：只求 {1}"),
    "speed facts": (
        "{0} cores, {1}; {2}; best of {3} runs over {4} positions; errors at {5} positions against 50 digits",
        "{0} 核，{1}；{2}；{4} 个位置取 {3} 次中最快；误差在 {5} 个位置与 50 位结果比较",
    ),
    "speed hand": (
        "By hand: {0} acts counted, 20 s each taken for granted. Size 1 fills the sheet.",
        "手工：计 {0} 次操作，每次按 20 s 计。图幅 1 为充满图纸。",
    ),
    "skipped": ("Left out: {0}.", "未列入：{0}。"),
    "skip not installed": ("is not installed", "未安装"),
    "skip one crank": ("knows only one crank on the frame that turns fully", "只能处理机架上一个整转曲柄"),
    "skip steady": ("knows no acceleration of the crank in a sweep", "扫掠时不能给曲柄角加速度"),
    "skip points": ("cannot place these points", "不能给出这些点"),
    "skip group": ("has no {0} group of this kind in its compiled sweep", "其编译扫掠没有这种 {0} 杆组"),
    "speed lesson draw": (
        "Draw one position, to see where its numbers come from: a pencil gives about 1 % in half an hour and no more "
        "on larger paper; the same construction drawn exactly gives all 15 digits in a millisecond.",
        "作图适用于单个位置，用来看清数值从何而来：铅笔半小时约得 1 %，图纸再大也不多；"
        "同一作图由机器精确完成，一毫秒即得 15 位。",
    ),
    "speed lesson compute": (
        "Compute a whole turn, or many designs: the closed form takes less than a thousandth of the exact drawing's "
        "time.",
        "整周或多方案应当计算：解析式耗时不到精确作图的千分之一。",
    ),
    "speed lesson lose": (
        "Differences take longer than the formula and lose a third to half of its digits; single precision halves the "
        "time for 7 digits; Newton's method takes some hundred times as long for the same digits.",
        "差分比解析式更慢，却丢掉三分之一到一半的位数；单精度耗时减半，只有 7 位；牛顿法得到同样位数约慢百倍。",
    ),
    "left out elements": (
        "Left out, since nothing asked for needs it: links {0}",
        "所求的量不需要，故略去：构件 {0}",
    ),
    "left out accelerations": (
        "Left out, since nothing asked for needs it: the accelerations of links {0}",
        "所求的量不需要，故略去：构件 {0} 的加速度",
    ),
}
