"""The parts of a release in CycloneDX: firmware images, libraries in these images, tools, and files
of third parties."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Iterable, Mapping
from datetime import UTC, datetime
from pathlib import Path
from uuid import NAMESPACE_URL, uuid5

from cyclonedx.model import HashAlgorithm, HashType
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentScope, ComponentType
from cyclonedx.model.license import LicenseExpression
from cyclonedx.output.json import JsonV1Dot6
from packageurl import PackageURL

from tools.steps import FailureError
from traceability.reading.build_evidence import LINKED

NAME = "weeding_robot.cdx.json"
PROJECT = "weeding_robot"
LICENCE = "Apache-2.0"
LOCK = Path("setup/python.lock")
VENDORED = Path("setup/vendored.txt")
PINNED = re.compile(r"^([A-Za-z0-9._-]+)==([^ ;\\]+)", re.MULTILINE)
FILE = re.compile(r"^([0-9a-f]{64})  (\S+)$", re.MULTILINE)


def sbom_text(root: Path, version: str, commit: str, when: int, images: Mapping[str, str]) -> str:
    """Returns the list of the parts, as a text. ``images`` has the SHA-256 of each firmware
    image."""
    product = Component(
        name=PROJECT,
        version=version,
        type=ComponentType.FIRMWARE,
        bom_ref=PROJECT,
        licenses=[LicenseExpression(LICENCE)],
    )
    bom = Bom(serial_number=uuid5(NAMESPACE_URL, f"{PROJECT}:{commit}"))
    bom.metadata.component = product
    bom.metadata.timestamp = datetime.fromtimestamp(when, UTC)
    parts = [*_images(images, version), *_linked()]
    others = [*_python(root), *_vendored(root)]
    bom.components.update([*parts, *others])
    bom.register_dependency(product, parts)
    return JsonV1Dot6(bom).output_as_string(indent=1) + "\n"


def _images(images: Mapping[str, str], version: str) -> Iterable[Component]:
    for name, digest in images.items():
        yield Component(
            name=name,
            version=version,
            type=ComponentType.FIRMWARE,
            bom_ref=f"image:{name}",
            licenses=[LicenseExpression(LICENCE)],
            hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest)],
        )


def _linked() -> Iterable[Component]:
    """Returns the libraries of C, of C++ and of the compiler, with their versions on this
    computer."""
    for name in LINKED:
        version = debian_version(name)
        yield Component(
            name=name,
            version=version,
            type=ComponentType.LIBRARY,
            bom_ref=f"deb:{name}",
            purl=PackageURL("deb", "debian", name, version),
        )


def debian_version(name: str) -> str:
    words = ["dpkg-query", "-W", "-f", "${Version}", name]
    try:
        done = subprocess.run(words, capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return ""
    return done.stdout.strip() if done.returncode == 0 else ""


def _python(root: Path) -> Iterable[Component]:
    """Returns the packages of the tools. They are not part of a firmware image."""
    packages = PINNED.findall((root / LOCK).read_text(encoding="utf-8"))
    if not packages:
        raise FailureError(f"{LOCK} names no package; restore it from git")
    for name, version in packages:
        yield Component(
            name=name,
            version=version,
            type=ComponentType.LIBRARY,
            scope=ComponentScope.EXCLUDED,
            bom_ref=f"pypi:{name}@{version}",
            purl=PackageURL("pypi", None, name, version),
        )


def _vendored(root: Path) -> Iterable[Component]:
    for digest, path in FILE.findall((root / VENDORED).read_text(encoding="utf-8")):
        yield Component(
            name=path,
            type=ComponentType.FILE,
            scope=ComponentScope.EXCLUDED,
            bom_ref=f"file:{path}",
            hashes=[HashType(alg=HashAlgorithm.SHA_256, content=digest)],
        )
