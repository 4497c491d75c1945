"""The commands and folders that the README names."""

from pathlib import Path

from traceability.checks.link_checks import missing_commands, missing_paths


def test_commands_options_and_folders_that_are_missing_are_found(tmp_path: Path) -> None:
    (tmp_path / "tools").mkdir()
    (tmp_path / "tools" / "sim.py").write_text('add_parser("sim")\nadd("--board")\n')
    readme = tmp_path / "README.md"
    readme.write_text("./wr sim --board  # runs\n./wr sim --help\n./wr fly --high\n| `lost/` |\n")
    assert [finding.text for finding in missing_commands(tmp_path)] == [
        "./wr has no fly",
        "./wr has no --high",
    ]
    assert [finding.text for finding in missing_paths(tmp_path)] == ["there is no lost/"]
