"""module-*: each design module has one place, one function, one secret and a full interface."""

from __future__ import annotations

from pathlib import Path

from traceability.model.annotations import Text
from traceability.model.facts import Facts
from traceability.model.schema import Finding, Method, Model, Module, is_extension
from traceability.sources import DESIGN, SRC


def check(model: Model, facts: Facts) -> list[Finding]:
    found: list[Finding] = []
    secrets: dict[str, str] = {}
    for module in model.modules.values():
        if module.datatype:
            continue
        described = facts.annotations.classes.get(module.qualified)
        text = described.text if described else Text()
        found += _place_and_name(module, facts)
        found += _function_and_secret(module, text, secrets)
        for method in module.methods:
            if method.access == "public":
                found += _specification(method)
    return found + _folders(model, facts)


def _place_and_name(module: Module, facts: Facts) -> list[Finding]:
    found: list[Finding] = []
    folder = Path(module.header).parent
    if not (facts.root / folder / "module.dox").exists() or str(folder) in DESIGN:
        found.append(
            Finding(
                module.place,
                "module-logic",
                f"{module.name} lies in {folder}, which is no described logic module",
                f"describe the folder in {folder}/module.dox, or move the module",
            )
        )
    if Path(module.header).stem != module.name:
        found.append(
            Finding(
                module.place,
                "module-name",
                f"the module {module.name} stands in {Path(module.header).name}",
                f"move it to {module.name}.hpp, or mark a value type with @datatype",
            )
        )
    names = facts.declared.names
    if names and not module.extension and module.name not in names.get(module.logic, []):
        found.append(
            Finding(
                module.place,
                "module-count",
                f"{module.name} is no module of {module.logic} in design/modules.toml",
                "remove it, mark a value type with @datatype, or change the design",
            )
        )
    return found


def _function_and_secret(module: Module, text: Text, secrets: dict[str, str]) -> list[Finding]:
    found: list[Finding] = []
    if not module.brief or not module.function:
        missing = "@brief" if not module.brief else "@function"
        found.append(
            Finding(
                module.place,
                "module-function",
                f"{module.name} has no {missing}",
                "say above the class what the module is for",
            )
        )
    count = len([secret for secret in text.all("Secret") if secret])
    if count != 1:
        found.append(
            Finding(
                module.place,
                "module-secret",
                f"{module.name} has {count or 'no'} {'secrets' if count else 'secret'}",
                "state above the class the one likely change that it hides, with @secret",
            )
        )
    elif module.secret in secrets:
        found.append(
            Finding(
                module.place,
                "module-secret",
                f"{module.name} states the same secret as {secrets[module.secret]}",
                "state what this module alone hides",
            )
        )
    else:
        secrets[module.secret] = module.name
    return found


def _specification(method: Method) -> list[Finding]:
    if method.name.startswith("operator") and not method.documented:
        return []
    missing: list[str] = []
    if not method.brief:
        missing.append("@brief")
    missing += [f"@param {param.name}" for param in method.params if param.name and not param.text]
    if _gives_result(method) and not method.returns:
        missing.append("@return")
    return [
        Finding(
            method.place,
            "module-spec",
            f"{method.id} has no {what}",
            "write it above the declaration",
        )
        for what in missing
    ]


def _gives_result(method: Method) -> bool:
    if method.kind == "constructor":
        return False
    words = method.signature.split("(")[0].removeprefix("virtual ").removeprefix("static ")
    return not words.startswith("void ") and " " in words


def folder_of(logic: str) -> str:
    return logic if is_extension(logic) else f"{SRC}/{logic}"


def _folders(model: Model, facts: Facts) -> list[Finding]:
    found: list[Finding] = []
    for logic in model.logic_modules.values():
        if logic.id not in facts.annotations.folders and not logic.place.file.endswith(".dox"):
            missing = ["@dir"]
        else:
            texts = {"@brief": logic.brief, "@function": logic.function, "@secret": logic.secret}
            missing = [name for name, text in texts.items() if not text]
        found += [
            Finding(
                logic.place,
                "module-folder",
                f"the logic module {logic.id} has no {name}",
                f"write it in {folder_of(logic.id)}/module.dox",
            )
            for name in missing
        ]
    return found
