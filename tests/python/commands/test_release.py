"""./wr release: archives that depend only on their content, the list of the software parts (SBOM),
and the release notes."""

import hashlib
import json
import os
import re
import subprocess
import tarfile
from pathlib import Path

import jsonschema
import pytest
from cyclonedx import schema as cyclonedx_schemas
from referencing import Registry, Resource
from referencing.jsonschema import DRAFT7

from tests.python.git_project import git
from tools import release
from tools.release_files import below, sums_text, write_archive
from tools.sbom import LOCK, sbom_text
from tools.steps import FailureError

pytestmark = pytest.mark.runs_tools

ROOT = Path(__file__).parents[3]
WHEN = 1_700_000_000
COMMIT = "0123456789abcdef0123456789abcdef01234567"
MADE = release.Release("1.0.0", COMMIT, WHEN)


# ---- archives --------------------------------------------------------------------


def test_an_archive_depends_on_its_content_alone(tmp_path: Path) -> None:
    paths = []
    for number, names in enumerate((["a", "b/c"], ["b/c", "a"])):
        folder = tmp_path / f"in {number}"
        for name in names:
            path = folder / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(f"content of {name}")
            path.chmod(0o600 if number else 0o755)
            os.utime(path, (number, number))
        paths.append(tmp_path / f"{number}.tar.gz")
        write_archive(paths[-1], below(folder), WHEN)
    assert paths[0].read_bytes() == paths[1].read_bytes()
    with tarfile.open(paths[0]) as archive:
        assert archive.getnames() == ["a", "b/c"]
        assert {entry.mtime for entry in archive} == {WHEN}


def test_the_sums_are_those_that_sha256sum_checks(tmp_path: Path) -> None:
    (tmp_path / "b").write_text("1")
    (tmp_path / "a").write_text("2")
    (tmp_path / "SUMS").write_text(sums_text(tmp_path, ["b", "a"]))
    words = ["sha256sum", "--check", "--strict", "SUMS"]
    assert subprocess.run(words, cwd=tmp_path, check=False, capture_output=True).returncode == 0
    (tmp_path / "a").write_text("3")
    assert subprocess.run(words, cwd=tmp_path, check=False, capture_output=True).returncode == 1


# ---- the list of the software parts (SBOM) ---------------------------------------


def validator() -> jsonschema.Draft7Validator:
    """Returns a validator for the schema that CycloneDX publishes. The schema is read from an
    installed package, so no network is needed."""
    folder = Path(str(cyclonedx_schemas.__file__)).parent / "_res"
    registry: Registry[object] = Registry()
    for name in ("bom-1.6", "spdx", "jsf-0.82"):
        content = json.loads((folder / f"{name}.SNAPSHOT.schema.json").read_text())
        resource = Resource.from_contents(content, default_specification=DRAFT7)
        registry = registry.with_resource(content["$id"], resource)
    schema = json.loads((folder / "bom-1.6.SNAPSHOT.schema.json").read_text())
    return jsonschema.Draft7Validator(schema, registry=registry)


def test_the_list_of_the_parts_fits_the_schema_of_cyclonedx() -> None:
    images = {"weeding_robot.bin": hashlib.sha256(b"image").hexdigest()}
    text = sbom_text(ROOT, "1.0.0", COMMIT, WHEN, images)
    assert text == sbom_text(ROOT, "1.0.0", COMMIT, WHEN, images)
    data = json.loads(text)
    validator().validate(data)
    parts = {part["name"]: part for part in data["components"]}
    assert parts["weeding_robot.bin"]["hashes"][0]["content"] == images["weeding_robot.bin"]
    pinned = re.findall(r"^([\w.-]+)==", (ROOT / LOCK).read_text(), re.MULTILINE)
    assert set(pinned) <= parts.keys()
    assert parts["pytest"]["scope"] == "excluded"
    assert "site/theme/static/minisearch.js" in parts
    assert data["metadata"]["timestamp"].startswith("2023-11-14T22:13:20")
    data["components"][0]["type"] = "thing"
    with pytest.raises(jsonschema.ValidationError):
        validator().validate(data)


# ---- the release -----------------------------------------------------------------


def test_the_notes_are_the_section_of_the_version(tmp_path: Path) -> None:
    (tmp_path / "CHANGELOG.md").write_text("# Changes\n\n## 1.1.0\n\nNew.\n\n## 1.0.0\n\nOld.\n")
    assert release.notes(tmp_path, MADE) == f"## 1.0.0\n\nOld.\n\nCommit {COMMIT}\n"
    with pytest.raises(FailureError, match=r"no section '## 2\.0\.0'"):
        release.notes(tmp_path, release.Release("2.0.0", COMMIT, WHEN))


def test_the_version_of_the_project_has_notes() -> None:
    found = release.VERSION.search((ROOT / "CMakeLists.txt").read_text())
    assert found
    assert release.notes(ROOT, release.Release(found[1], COMMIT, WHEN))


def test_a_release_is_made_of_a_commit_without_changes(tmp_path: Path) -> None:
    with pytest.raises(FailureError, match="not a git clone"):
        release.identity(tmp_path)
    git(tmp_path, "init", "-q")
    (tmp_path / "CMakeLists.txt").write_text("project(x VERSION 1.2.3)\n")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "x")
    assert release.identity(tmp_path).name == "weeding_robot-1.2.3"
    (tmp_path / "new").touch()
    with pytest.raises(FailureError, match="1 files differ from the commit"):
        release.identity(tmp_path)


def test_the_sources_of_a_release_can_be_executed_and_are_of_the_commit(tmp_path: Path) -> None:
    (tmp_path / "wr").write_text("#!/bin/sh\n")
    (tmp_path / "wr").chmod(0o755)
    for words in (["init", "-q"], ["add", "."], ["commit", "-qm", "x"]):
        git(tmp_path, *words)
    (tmp_path / "wr").write_text("changed later\n")
    made = release.Release("1.0.0", "HEAD", WHEN)
    archives = [tmp_path / "first.tar.gz", tmp_path / "second.tar.gz"]
    for path in archives:
        release.write_source(tmp_path, made, path)
    assert archives[0].read_bytes() == archives[1].read_bytes()
    with tarfile.open(archives[0]) as archive:
        content = archive.extractfile("weeding_robot-1.0.0/source/wr")
        assert content and content.read() == b"#!/bin/sh\n"
        assert archive.getmember("weeding_robot-1.0.0/source/wr").mode & 0o100


def test_different_releases_are_found(tmp_path: Path) -> None:
    for folder, content in (("a", "same"), ("b", "same")):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "file").write_text(content)
    first, second = tmp_path / "a", tmp_path / "b"
    assert release.differences(first, second) == []
    (second / "file").write_text("other")
    (second / "more").touch()
    assert release.differences(first, second) == [
        "more is only in one of the two releases",
        "file: the bytes differ",
    ]


def test_different_files_in_an_archive_are_named(tmp_path: Path) -> None:
    for folder, content in (("a", b"1"), ("b", b"2")):
        files: dict[str, bytes | Path] = {"same": b"0", "other": content}
        write_archive(tmp_path / folder / "x.tar.gz", files, WHEN)
    assert release.differences(tmp_path / "a", tmp_path / "b") == [
        "x.tar.gz: the bytes differ",
        "  other",
    ]
