"""./wr prove: proves the properties of the state machines with the model checker Spin."""

from __future__ import annotations

import argparse
from pathlib import Path

from tools.lock import only_one
from tools.proof_runs import missing_program, prove, record_proofs
from tools.steps import MissingError, UsageError
from tools.tasks import graph
from traceability.reading.declared import read_declared
from traceability.reading.task_record import PROOFS
from weeding_robot_client.exit_codes import MISSING


def add(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    parser = commands.add_parser(
        "prove",
        description="Generates a model from the state machines of design/fsm and from "
        "design/proofs/robot.pml, which models the other parts of the robot. Proves the properties "
        "of design/proofs/properties.toml with the model checker Spin. The results are in "
        "build/results/proofs.json and on the page 'Proofs' of the portal. The exit code "
        f"{MISSING} means that Spin or a C compiler is missing.",
    )
    parser.add_argument(
        "properties",
        nargs="*",
        metavar="PROPERTY",
        help="prove only these properties, and record nothing",
    )
    parser.add_argument(
        "--again",
        action="store_true",
        help="prove all properties, including the properties whose models are in "
        "tests/records/proofs.json. Then write this record again",
    )
    parser.set_defaults(run=run)


def run(root: Path, options: argparse.Namespace) -> int:
    declared = read_declared(root)
    unknown = set(options.properties) - set(declared.proofs)
    if unknown:
        names = ", ".join(declared.proofs)
        raise UsageError(f"there is no property {min(unknown)}; the properties are {names}")
    if missing := missing_program():
        raise MissingError(f"{missing} is not installed; install it with ./wr setup")
    with only_one(root, "prove"):
        if not options.properties and not options.again:
            return 1 if graph(root).run([PROOFS]).failed else 0
        chosen = [declared.proofs[name] for name in options.properties or declared.proofs]
        results = prove(root, declared, chosen, print)
        if not options.properties:
            print(f"recorded in {record_proofs(root, declared, results).relative_to(root)}")
        return 0 if all(result.verdict == "proven" for result in results.values()) else 1
