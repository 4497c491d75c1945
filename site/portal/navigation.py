"""The side navigation, which is the same on every page. Numbers next to its titles, such as the
number of requirements, are from the model."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from itertools import chain
from pathlib import Path

from traceability.model.design_model import Model
from traceability.reading.products import PRODUCTS
from traceability.reading.source_lines import headings

# The hand-written pages of each group, in this order. A hand-written page that is not listed here
# is in the group "build".
DOCS = {
    "build": (
        "quick_start",
        "client",
        "emulator",
        "scenarios",
        "debugging",
        "bring_up",
        "other_tools",
    ),
    "verify": ("hazards",),
    "explain": (
        "execution_model",
        "wheel_control",
        "steering_control",
        "plant",
        "host_target",
        "add_extension",
        "product_line",
        "contributing",
        "annotations",
        "glossary",
    ),
}


@dataclass
class Entry:
    """A page in the navigation. If the page is generated, ``id`` is the name of its template."""

    id: str
    title: str
    address: str
    key: str = ""
    count: int | None = None


@dataclass
class Group:
    """Pages that serve the same aim of a reader, under a common title."""

    id: str
    title: str
    entries: list[Entry]


def hand_written(folder: Path) -> list[Entry]:
    """Returns the pages below ``docs/``. The pages for beginners are first. The title of a page is
    its first heading, or the name of its file."""
    names = {path: str(path.relative_to(folder).with_suffix("")) for path in folder.rglob("*.rst")}
    pages = [
        Entry(f"docs/{name}", next(headings(path), path.stem), f"docs/{name}.html")
        for path, name in sorted(names.items())
    ]
    order = {f"docs/{name}": number for number, name in enumerate(chain(*DOCS.values()))}
    return sorted(pages, key=lambda page: (order.get(page.id, len(order)), page.title.lower()))


class Navigation:
    """The groups of pages in the side navigation. Each group serves one aim of a reader."""

    def __init__(
        self, model: Model, docs: list[Entry], checks: int, faults: int, questions: int
    ) -> None:
        written: dict[str, list[Entry]] = {group: [] for group in DOCS}
        for doc in docs:
            name = doc.id.removeprefix("docs/")
            group = next((group for group, names in DOCS.items() if name in names), "build")
            written[group].append(doc)
        source = Entry("source", "Source", "source/index.html", "S")
        tuning = Entry("tuning", "Values to tune", "tuning.html")
        messages = Entry("messages", "Messages of the commands", "messages.html")
        exports = Entry("exports", "Exports", "exports.html")
        live = Entry("run", "Run the robot", "run.html")
        plot = Entry("plot", "Plot a recording", "plot.html")
        answers = Entry("answers", "Answers", "answers/index.html", "", questions)
        answers_ = [answers] if questions else []
        self.groups = [
            Group("understand", "Understand", [*answers_, *understand(model)]),
            Group("verify", "Verify", [*verify(model, checks, faults), *written["verify"]]),
            Group(
                "build",
                "Build and use",
                [live, plot, *written["build"], tuning, messages, source, exports],
            ),
        ]
        if explain := written["explain"]:
            self.groups.append(Group("explain", "Explanations", explain))
        self.entries = {entry.id: entry for group in self.groups for entry in group.entries}

    def data(self) -> list[dict[str, object]]:
        return [asdict(group) for group in self.groups]


def understand(model: Model) -> list[Entry]:
    """Returns the pages in the order in which a newcomer should read them."""
    modules = [module for module in model.modules.values() if not module.datatype]
    designs = sum(not module.extension for module in modules)
    types = len(model.modules) - len(modules)
    patterns = len(model.patterns)
    return [
        Entry("architecture", "Architecture", "architecture.html"),
        Entry("structure", "Module structure", "structure.html", "", designs),
        Entry("patterns", "Pattern applications", "patterns/index.html", "P", patterns),
        Entry("machines", "State machines", "machines.html", "", len(model.machines)),
        Entry("changes", "Likely changes", "changes.html", "", len(model.changes)),
        Entry("secrets", "Secrets", "secrets.html", "", designs),
        Entry("guide", "Module guide", "guide.html", "G"),
        Entry("interfaces", "Interfaces", "interfaces.html", "I"),
        Entry("inheritances", "Interface inheritances", "inheritances.html"),
        Entry("products", "Product line", "products.html", "", len(PRODUCTS)),
        Entry("datatypes", "Data dictionary", "datatypes.html", "", types),
        Entry("uses", "Uses", "uses.html"),
        Entry("concordance", "Concordance with the paper", "concordance.html"),
        Entry("usual_design", "Baseline design", "usual_design.html"),
        Entry("execution", "Execution", "execution.html", "", len(model.contexts)),
        Entry("cycle", "One cycle", "cycle.html"),
        Entry("bytes", "Follow a byte", "bytes.html"),
        Entry("sequences", "Sequences", "sequences.html"),
    ]


def verify(model: Model, checks: int, faults: int) -> list[Entry]:
    requirements, case = model.requirements, model.safety
    trees = sum(requirement.tree is not None for requirement in requirements.values())
    safety = [
        Entry("safety", "Safety case", "safety/index.html", "", len(case.goals)),
        Entry("safety_cost", "Cost of the safety extensions", "safety/cost.html"),
    ]
    return [
        Entry("requirements", "Requirements", "requirements/index.html", "R", len(requirements)),
        Entry("dossier", "Dossier", "dossier/index.html", "", len(requirements)),
        *(safety if case.goals else []),
        Entry("trees", "Invocation trees", "trees.html", "", trees),
        Entry("tests", "Tests", "tests.html", "T", len(model.tests)),
        Entry("proofs", "Proofs", "proofs.html", "", len(model.proofs.properties)),
        Entry("mutation", "Mutants", "mutation.html"),
        Entry("robustness", "Evidence of robustness", "robustness.html"),
        Entry("reverse", "Code without a requirement", "reverse.html"),
        Entry("closed_loop", "Control performance", "closed_loop.html", "", len(model.closed_loop)),
        Entry("bench", "Bench", "bench.html"),
        Entry("virtual_k64", "Run-time checks of the virtual board", "virtual_k64.html"),
        Entry("beliefs", "Beliefs of the virtual board", "beliefs.html", "", len(model.beliefs)),
        Entry("build_evidence", "Evidence of this build", "evidence.html"),
        Entry("differences", "Differences of two commits", "differences.html"),
        Entry("checks", "Checks", "checks/index.html", "", checks),
        Entry("drift", "Test of the checks", "checks/drift.html", "", faults),
    ]
