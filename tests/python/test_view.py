"""hooke.view and hooke.write_xdmf."""

import json
import os

import pytest

import hooke

pytestmark = pytest.mark.skipif(not hooke.build_facts()["threejs"], reason="this build writes no pages")


def data_of(page):
    text = page.read_text(encoding="utf-8")
    start = text.index('id="data">') + len('id="data">')
    return json.loads(text[start:text.index("</script>", start)])


def test_a_page_of_a_result_and_of_a_file(scene, tmp_path):
    result = scene.run(output=tmp_path / "out.h5")
    page = hooke.view(result)
    assert page == tmp_path / "out.html" and data_of(page)["title"] == "six particles"
    assert data_of(page)["frames"] == 11
    page = hooke.view(os.fspath(tmp_path / "out.h5"), tmp_path / "other.html", title="mine", frames=3)
    assert page == tmp_path / "other.html"
    assert (data_of(page)["title"], data_of(page)["frames"], data_of(page)["frame_stride"]) == ("mine", 3, 5)


def test_a_system_without_a_scene(system, tmp_path):
    result = hooke.run(system, method="rk4", step=1e-3, duration=0.01, output=tmp_path / "out.h5")
    data = data_of(hooke.view(result))
    assert (data["title"], data["by_first_frame"], data["springs"]) == ("out.h5", False, 7)
    assert (tmp_path / "out.xdmf").read_text().count("<Time ") == data["frames_there"]


def test_what_is_refused(scene, tmp_path):
    with pytest.raises(hooke.BadValue, match="output="):
        hooke.view(scene.run())
    result = scene.run(output=tmp_path / "out.h5")
    with pytest.raises(hooke.BadValue, match="frames"):
        hooke.view(result, frames=1)
    with pytest.raises(hooke.BadValue, match="size"):
        hooke.view(result, size=0.1)
    with pytest.raises(hooke.IOFailed):
        hooke.view(tmp_path / "nothing.h5")
    with pytest.raises(hooke.IOFailed):
        hooke.view(result, tmp_path / "nowhere/page.html")


def test_a_name_that_paraview_cannot_take(scene, tmp_path):
    with pytest.warns(UserWarning, match="ASCII without colons"):
        result = scene.run(output=tmp_path / "a:b.h5")
    assert result.status == "finished"
    with pytest.raises(hooke.BadValue, match="ASCII"):
        hooke.write_xdmf(result)
