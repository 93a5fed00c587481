"""Results as a notebook shows them, as pages, and as data frames, of a scene whose texts would be markup; what is shown
reaches no further than its frame."""

import copy
import html
import re
import warnings

import numpy as np
import pytest
from conftest import SIX_PARTICLES

import hooke
from hooke._measurement import Found
from hooke.notebook import table

STRANGE = "</script><b>\"'&amp;"
ROPE = {"kind": "rope", "name": f"rope{STRANGE}", "from": [9, 0, 0], "to": [9.4, 0, 0], "segments": 4, "mass": 0.1,
        "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}}

FACTS = hooke.build_facts()
needs_pages = pytest.mark.skipif(not FACTS["chartjs"] or not FACTS["threejs"], reason="this build writes no pages")


@pytest.fixture
def scene():
    text = copy.deepcopy({**SIX_PARTICLES, "title": STRANGE, "parts": [ROPE]})
    text["springs"][0]["name"] = STRANGE
    return hooke.Scene.parse(text)


@pytest.fixture
def strange_path(tmp_path):
    """Of a file whose name ends a script, too."""
    (tmp_path / "<").mkdir()
    return tmp_path / "<" / "script><b>out.h5"


def undated(page):
    """Without the minute at which it was made."""
    return re.sub('"date":"[^"]*"', "", page)


def page_in(shown):
    """The page that a frame embeds, which loads nothing, has no tags of others, and cannot reach the notebook."""
    frame = r'<iframe srcdoc="([^"]*)" style="[^"]*" sandbox="allow-scripts allow-downloads"></iframe>'
    page = undated(html.unescape(re.fullmatch(frame, shown)[1]))
    assert "</script><" not in page and "<b>" not in page
    assert not re.search(r'(?:src|href)="(?!data:|#|$)', re.sub(r"<script\b.*?</script>", "", page, flags=re.S))
    return page


def results(scene):
    yield hooke.study(scene, ["rk4", "verlet"], duration=0.05, every=0.05, points=6)
    yield hooke.limit(scene, predict=True)
    yield hooke.needs(scene, 1e-3, method="verlet", duration=1.0)


@needs_pages
@pytest.mark.skipif(not FACTS["sundials"] or not FACTS["lapack"], reason="this build measures less")
def test_results_show_their_pages(scene, tmp_path):
    for result in results(scene):
        name = type(result).__name__
        assert "<canvas" in page_in(result._repr_html_()), name
        assert undated(result.report(tmp_path / f"{name}.html").read_text("utf-8")) == page_in(result._repr_html_())
        with pytest.raises(ValueError, match=".html"):
            result.report(tmp_path / "page.txt")


@needs_pages
def test_a_trajectory_is_shown_by_the_viewer(scene, strange_path):
    result = scene.run(output=strange_path)
    with hooke.open(strange_path) as trajectory:
        assert 'id="data"' in page_in(trajectory._repr_html_())
    words, _, frame = result._repr_html_().rpartition("</p>")
    assert 'id="data"' in page_in(frame) and words.startswith("<p>the error is at most ")
    assert scene.run(estimate=False)._repr_html_() is None


@needs_pages
def test_what_is_to_be_run_is_shown_and_stays_open(scene):
    assert 'id="data"' in page_in(scene._repr_html_())
    open_scene = hooke.Scene(STRANGE, gravity=(0, -9.81, 0)).particles([[0, 0, 0], [1, 0, 0]], mass=1)
    assert 'id="data"' in page_in(open_scene._repr_html_()) and not open_scene.system.is_committed
    open_scene.springs(between=[[0, 1]], stiffness=1)
    assert hooke.System()._repr_html_() is None


@needs_pages
def test_a_diverged_run_without_a_file_plays_why(scene):
    with pytest.warns(hooke.StepWarning):
        result = scene.run(step=1.0, every=1.0, duration=100.0)
    assert "diverged" in page_in(result._repr_html_())


@needs_pages
def test_a_diverged_run_says_why(scene, strange_path, tmp_path):
    with pytest.warns(hooke.StepWarning):
        result = scene.run(step=1.0, every=1.0, duration=100.0, output=strange_path)
    assert result.status == "diverged" and STRANGE in result.diagnosis
    shown = result._repr_html_()
    assert shown.startswith(f"<p>{html.escape(result.diagnosis)}</p><iframe") and 'id="data"' in page_in(shown.partition("</p>")[2])
    why = hooke.why(result)
    assert undated(why.report(tmp_path / "why.html").read_text("utf-8")) == page_in(why._repr_html_())
    title = STRANGE.replace("<", r"\u003c").replace('"', r"\u0022")
    assert f'"scene":"{title}"' in page_in(why._repr_html_()).replace('": "', '":"')


@pytest.mark.skipif(not FACTS["sundials"] or not FACTS["lapack"], reason="this build measures less")
def test_others_show_their_rows(scene, tmp_path):
    cost = hooke.cost(scene, predict=True)
    for result in (cost, hooke.check(scene), *results(scene)):
        shown = Found._repr_html_(result)
        assert set(re.findall(r"<(\w+)", shown)) <= {"p", "div", "table", "tr", "th", "td"}
        assert [html.unescape(line) for line in re.findall("<p>([^<]*)</p>", shown)] == str(result).splitlines()
        texts = [html.unescape(cell) for cell in re.findall("<t[hd]>([^<]*)</t[hd]>", shown)]
        assert len(texts) == len(result.rows.dtype.names) * (1 + len(result.rows))
        known = {str(value) for row in result.rows.tolist() for value in row if isinstance(value, str)}
        assert known | set(result.rows.dtype.names) <= set(texts)
        assert any(STRANGE in text for text in texts) == isinstance(result, (hooke.Cost, hooke.Needs))
    assert cost._repr_html_() == Found._repr_html_(cost) in cost.report(tmp_path / "cost.html").read_text("utf-8")
    assert html.escape(STRANGE) in table(np.array([(0,)], [(STRANGE, float)]))


def test_every_kind_of_result_is_tried():
    shown = {name for name, kind in vars(hooke).items() if isinstance(kind, type) and hasattr(kind, "_repr_html_")}
    assert shown == {"Study", "Limit", "Needs", "Why", "Result", "Trajectory", "Cost", "Check", "Rest", "Modes",
                     "Scene", "System"}


def test_rows_become_a_data_frame(scene):
    pandas = pytest.importorskip("pandas")
    cost = hooke.cost(scene, predict=True)
    frame = cost.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == list(cost.rows.dtype.names)
    assert np.array_equal(frame["memory_bytes"], cost.rows["memory_bytes"], equal_nan=True)


def test_a_film_without_ffmpeg(scene, tmp_path, monkeypatch):
    pytest.importorskip("matplotlib")
    pytest.importorskip("h5py")
    if not FACTS["hdf5"]:
        pytest.skip("this build writes no trajectories")
    scene.run(output=tmp_path / "out.h5")
    monkeypatch.setattr("matplotlib.animation.writers.is_available", lambda name: False)
    with hooke.open(tmp_path / "out.h5") as trajectory:
        film = trajectory.animate(seconds=0.2)
        with pytest.raises(hooke.NotBuilt, match="ffmpeg"):
            film.save(tmp_path / "film.mp4")
        film.save(tmp_path / "film.html")
    assert "<img" in (tmp_path / "film.html").read_text("utf-8")


@needs_pages
def test_a_scene_without_a_title_has_a_picture_and_no_warning():
    scene = hooke.Scene().particles([[0, 0, 0], [1, 0, 0]], mass=1).springs(between=[[0, 1]], stiffness=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # nothing moves
        assert "<iframe" in scene._repr_html_()
