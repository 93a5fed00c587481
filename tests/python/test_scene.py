

def test_values_that_replace_those_of_a_text():
    text = '{"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": 1}, "drag": 1}'
    values = {"gravity": np.array([0, -1, 0]), "drag": np.float64(0.5), "title": 'a = "b"', "run.step": "1ms"}
    changed = json.loads(hooke.Scene.parse(text, set=values).text)
    assert changed["gravity"] == [0, -1, 0] and changed["drag"] == 0.5
    assert changed["title"] == 'a = "b"' and changed["run"] == {"step": "1ms"}
    with pytest.raises(hooke.BadValue, match='did you mean "drag"'):
        hooke.Scene.parse(text, set={"darg": 1})
