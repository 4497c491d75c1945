"""The command line: help, wrong use, and the shell script that installs the packages."""

import os
import re
import signal
import socket
import subprocess
import sys
import urllib.request
from pathlib import Path
from threading import Thread

import pytest

from tools import cli, lint, serve
from tools.includes import direct
from tools.steps import FailureError

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]
USAGE = (ROOT / "wr").read_text(encoding="utf-8").partition("\nTEXT\n")[0]
COMMANDS = re.findall(r"^  ([a-z-]+) ", USAGE, re.MULTILINE)


def wr(*arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [ROOT / "wr", *arguments],
        env={**os.environ, **environment},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


def test_every_command_of_the_help_is_one_of_the_parser_and_no_other_is() -> None:
    (choices,) = (one.choices for one in cli.parser()._actions if one.dest == "command")
    assert choices is not None
    assert sorted(choices) == sorted(COMMANDS)
    assert wr("--help").stdout.startswith(USAGE.partition("TEXT'\n")[2])


@pytest.mark.parametrize("arguments", [(), ("fly",)])
def test_no_command_and_unknown_command_are_wrong_usage(arguments: tuple[str, ...]) -> None:
    assert wr(*arguments).returncode == 2


@pytest.mark.parametrize(
    "arguments",
    [
        ("serve", "--port", "0"),
        ("serve", "--port", "x"),
        ("test", "everything"),
        ("sim", "--cycles", "0"),
        ("sim", "--trace", "file"),
        ("sim", "--gdb", "7777"),
        ("sim", "--board", "--gdb", "70000"),
        ("sim", "--board", "--fast"),
        ("sim", "--reports", "file"),
        ("flash", "--with", "wire"),
        ("monitor", "--reports", "0"),
        ("check", "--fast"),
    ],
)
def test_wrong_options_are_wrong_usage(
    arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit) as ended:
        cli.main(list(arguments))
    assert ended.value.code == 2
    assert arguments[-1] in capsys.readouterr().err


def test_set_up_does_nothing_when_nothing_is_missing() -> None:
    wr("setup")
    result = wr("setup")
    assert (result.returncode, result.stdout, result.stderr) == (0, "", "")


def tools_without(tmp_path: Path, *missing: str, **scripts: str) -> str:
    """Returns a search path with the tools that wr calls. Some tools can be left out or
    replaced.
    """
    for tool in ("sh", "dirname", "cat", "sed", "tr", "grep", "id", "env", "sha256sum"):
        if tool not in missing:
            (tmp_path / tool).symlink_to(f"/usr/bin/{tool}")
    for name, text in scripts.items():
        path = tmp_path / name.replace("_", "-")
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)
    return str(tmp_path)


def test_a_machine_without_apt_is_told_what_to_install(tmp_path: Path) -> None:
    result = wr("setup", PATH=tools_without(tmp_path))
    assert result.returncode == 3
    assert "cmake " in result.stderr
    assert "# runs the builds" in result.stderr


@pytest.mark.parametrize("scripts", [{}, {"sudo": "exit 1"}])
def test_a_user_who_may_not_install_is_told_the_command(
    tmp_path: Path, scripts: dict[str, str]
) -> None:
    """There is no sudo, or sudo refuses."""
    path = tools_without(
        tmp_path, "id", id="echo 1000", dpkg_query="true", apt_get="exit 9", **scripts
    )
    result = wr("setup", PATH=path)
    assert result.returncode == 3
    command = result.stderr.splitlines()[-1].split()
    assert command[:3] == ["apt-get", "install", "--no-install-recommends"]
    assert {"python3", "g++", "chromium"} < set(command)


def test_only_missing_packages_are_installed_and_named_before(tmp_path: Path) -> None:
    names = [
        line.split("#")[0].strip() for line in (ROOT / "setup/debian.txt").read_text().splitlines()
    ]
    present = "\n".join(f"{name} installed" for name in names if name and name != "ninja-build")
    path = tools_without(
        tmp_path,
        "id",
        id="echo 0",
        dpkg_query=f"cat <<'END'\n{present}\nninja-build not-installed\nEND",
        apt_get='echo "apt-get $*"; case "$*" in *install*) exit 7 ;; esac',
    )
    result = wr("setup", PATH=path)
    lines = result.stdout.splitlines()
    assert lines[0] == "wr: these packages are missing:"
    assert lines[1].split() == ["ninja-build", "#", "runs", "the", "builds"]
    assert lines[-1].split()[-1] == "ninja-build"
    assert result.returncode == 7


def test_serve_needs_a_portal(tmp_path: Path) -> None:
    with pytest.raises(FailureError, match=r"\./wr portal"):
        serve.make_server(tmp_path, 8000)


def test_serve_says_when_the_port_is_taken(tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("portal")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(FailureError, match=f"port {port} is in use"):
            serve.make_server(tmp_path, port)


def test_serve_serves_the_portal_to_this_machine_only(tmp_path: Path) -> None:
    (tmp_path / "index.html").write_text("portal")
    with serve.make_server(tmp_path, 0) as server:
        host, port = server.server_address[:2]
        assert host == "127.0.0.1"
        Thread(target=server.serve_forever, daemon=True).start()
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/") as page:
            assert page.read() == b"portal"
        server.shutdown()


INTERRUPTED = """
import argparse, signal, sys
from tools import cli
from tools.steps import heed_interrupts
options = argparse.Namespace(
    command="check", run=lambda *_: signal.raise_signal(signal.Signals[sys.argv[1]]))
argparse.ArgumentParser.parse_known_args = lambda *_: (options, [])
heed_interrupts()
sys.exit(cli.main([]))
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_ends_with_130(number: signal.Signals) -> None:
    words = [sys.executable, "-c", INTERRUPTED, number.name]
    done = subprocess.run(words, capture_output=True, text=True, check=False, cwd=ROOT, timeout=60)
    assert (done.returncode, done.stderr) == (130, "interrupted\n")


def test_only_files_whose_content_or_includes_changed_are_checked_again(tmp_path: Path) -> None:
    (tmp_path / "src").mkdir()
    (tmp_path / ".clang-tidy").touch()
    (tmp_path / "src/a.hpp").write_text("int a;\n")
    (tmp_path / "src/b.cpp").write_text('#include "a.hpp"\n')
    (tmp_path / "src/c.cpp").write_text("int c;\n")
    units = [(tmp_path / "src/b.cpp",), (tmp_path / "src/c.cpp",)]

    def check(command: str = "true") -> str:
        direct.cache_clear()
        with (tmp_path / "log").open("a") as log:
            return lint.check_changed(
                tmp_path, "test", units, lambda unit: [command, *map(str, unit)], log
            )

    assert check() == "2 files, 2 of them changed"
    assert check() == "2 files, 0 of them changed"
    (tmp_path / "src/a.hpp").write_text("int b;\n")
    assert check() == "2 files, 1 of them changed"
    with pytest.raises(FailureError, match="2 of 2"):
        check("false")
    assert check() == "2 files, 2 of them changed"


def test_sources_without_a_private_name_in_common_are_checked_as_one(tmp_path: Path) -> None:
    texts = {"a": "const int kA = 1;\nint a() {\n}\n", "b": "void B::go() {\n}\n", "c": ""}
    texts |= {"d": "constexpr int kA{2};\n", "e": "int e() {\n}\n"}
    paths = [tmp_path / f"{name}.cpp" for name in texts]
    for path in paths:
        path.write_text(f"namespace wr {{\n{texts[path.stem]}}}  // namespace wr\n")
    a, b, c, d, e = paths
    assert lint.units_of(tmp_path, paths) == [(a, b, c, e), (d,)]


def test_sources_with_other_settings_or_options_are_checked_apart(tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("src/a.cpp", "ports/b.cpp", "src/x/c.cpp", "src/y/d.cpp")]
    for path in paths:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    (tmp_path / "src/y/.clang-tidy").touch()
    a, b, c, d = paths
    assert lint.units_of(tmp_path, paths) == [(a, c), (b,), (d,)]


def test_a_unit_fails_only_with_the_files_that_fail_alone(tmp_path: Path) -> None:
    (tmp_path / ".clang-tidy").touch()
    unit = (tmp_path / "a.cpp", tmp_path / "b.cpp")
    for path in unit:
        path.touch()

    def check(failing: str) -> str:
        with (tmp_path / "log").open("a") as log:
            return lint.check_changed(
                tmp_path, "test", [unit], lambda part: ["sh", "-c", f"{failing} {len(part)}"], log
            )

    assert check("test 1 -eq") == "2 files, 2 of them changed"
    assert check("test 1 -eq") == "2 files, 0 of them changed"
    with pytest.raises(FailureError, match="2 of 2"):
        check("test 0 -eq")
