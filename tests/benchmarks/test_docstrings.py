"""Docstrings are drawn by seed, from all of the package."""

from benchmarks import docstrings


def test_a_seed_draws_the_same_ones_again():
    drawn = docstrings.draw(14)
    assert len(drawn) == len(set(drawn)) == 10
    assert docstrings.draw(14) == drawn != docstrings.draw(15)


def test_methods_and_private_functions_are_among_them():
    names = {signature.split("(")[0] for _, signature, _ in docstrings.docstrings()}
    assert {"DebrisFlow.run_one_step", "solve_column", "AdvancedColumns.advance_to"} <= names


def test_the_draw_is_printed(capsys, monkeypatch):
    monkeypatch.setattr("sys.argv", ["docstrings", "--seed", "14", "--count", "2"])
    docstrings.main()
    printed = capsys.readouterr().out
    assert all(module in printed for module, _, _ in docstrings.draw(14, 2)) and "\n2. landlab_debrisflow" in printed
