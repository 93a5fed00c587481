"""Results as a notebook shows them, as pages, and as data frames."""

import html
import re

import numpy as np
import pytest

import hooke

FACTS = hooke.build_facts()
needs_pages = pytest.mark.skipif(not FACTS["chartjs"] or not FACTS["threejs"], reason="this build writes no pages")


def page_in(shown):
    """The page that a frame embeds, which loads nothing."""
    page = html.unescape(re.fullmatch(r'<iframe srcdoc="([^"]*)" style="[^"]*" sandbox="[^"]*"></iframe>', shown)[1])
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
        assert result.report(tmp_path / f"{name}.html").read_text("utf-8") == page_in(result._repr_html_())
        with pytest.raises(ValueError, match=".html"):
            result.report(tmp_path / "page.txt")


@needs_pages
def test_a_trajectory_is_shown_by_the_viewer(scene, tmp_path):
    result = scene.run(output=tmp_path / "out.h5")
    with hooke.open(tmp_path / "out.h5") as trajectory:
        assert 'id="data"' in page_in(trajectory._repr_html_())
    assert 'id="data"' in page_in(result._repr_html_())
    assert scene.run()._repr_html_() is None


@needs_pages
def test_a_diverged_run_says_why(scene, tmp_path):
    with pytest.warns(hooke.StepWarning):
        result = scene.run(step=1.0, every=1.0, duration=100.0, output=tmp_path / "out.h5")
    assert result.status == "diverged"
    shown = result._repr_html_()
    assert shown.startswith(f"<p>{html.escape(result.diagnosis)}</p><iframe") and 'id="data"' in page_in(shown.partition("</p>")[2])
    title = '"scene":"' + scene.title + '"'
    assert title in hooke.why(result).report(tmp_path / "why.html").read_text("utf-8").replace('": "', '":"')


def test_others_show_their_rows(scene, tmp_path):
    cost = hooke.cost(scene, predict=True)
    shown = cost._repr_html_()
    assert shown.count("<tr>") == 1 + len(cost.rows) and "<th>nanoseconds</th>" in shown
    assert shown in cost.report(tmp_path / "cost.html").read_text("utf-8")


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
