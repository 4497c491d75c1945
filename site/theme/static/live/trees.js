/* Functions for the recorded calls of a control cycle. They convert the calls to rows, find the declared invocation
   trees in these rows, and determine the states of the state machines. traceability/reading/traces.py has the same
   rules. */
(function (scope) {
  "use strict";

  /* Returns a row for each call: the method, the depth, the row number of the caller, the row number after the last
     nested call, and the number of the interrupt activation that made the call. */
  function rowsOf(calls, methodAt, hardware) {
    const rows = [];
    const open = [];
    let depth = 0,
      parent = -1,
      activation = 0,
      entries = 0;
    for (const event of calls) {
      const method = methodAt.get(event & ~1);
      if (method === undefined) continue;
      if (event & 1) {
        const [row, before] = open.length ? open.pop() : [-1, activation];
        activation = before;
        if (row >= 0) {
          rows[row].end = rows.length;
          depth -= 1;
          parent = rows[row].parent;
        }
      } else if (hardware.has(method)) {
        open.push([-1, activation]);
        entries += 1;
        activation = entries;
      } else {
        rows.push({ method, depth, parent, end: 0, activation });
        parent = rows.length - 1;
        open.push([parent, activation]);
        depth += 1;
      }
    }
    for (const [row] of open) if (row >= 0) rows[row].end = rows.length;
    return rows;
  }

  /* Converts a declared invocation tree for the search: each node gets its methods as a set. `needed` lists these
     sets. The recorded calls can contain the tree only if they contain a method of each set. */
  function prepared(declared, has) {
    const needed = [];
    const nodeOf = (node) => {
      const methods = new Set(node.m.filter((m) => has.has(m)));
      const children = (node.c || []).map(nodeOf);
      const outside = !children.length && !node.m.length;
      if (!outside) needed.push(methods);
      return { methods, children, outside, posted: Boolean(node.post), name: node.n };
    };
    const root = nodeOf(declared.tree);
    const possible = needed.length > 0 && needed.every((methods) => methods.size > 0);
    return { id: declared.id, text: declared.text, root, needed, possible };
  }

  /* Returns the row numbers of the nodes of an invocation tree, or null if the rows do not contain the tree. The
     calls of the children must be inside the call of the parent, in the declared order. A call that an interrupt made
     meanwhile is not a call of the parent. The call of a posted command may also begin after the call of the parent has
     ended. */
  function embed(tree, rows) {
    function fit(node, start, stop, activation) {
      for (let index = start; index < stop; index += 1) {
        const row = rows[index];
        if (!node.methods.has(row.method)) continue;
        if (activation !== null && row.activation !== activation) continue;
        const placed = [index];
        let position = index + 1,
          complete = true;
        for (const child of node.children) {
          if (child.outside) continue;
          const found = child.posted
            ? fit(child, position, rows.length, null)
            : fit(child, position, row.end, row.activation);
          if (!found) {
            complete = false;
            break;
          }
          placed.push(...found);
          position = rows[found[0]].end;
        }
        if (complete) return placed;
      }
      return null;
    }
    return fit(tree.root, 0, rows.length, null);
  }

  /* Returns the ids of the invocation trees that the rows contain. */
  function treesIn(trees, rows) {
    const present = new Set(rows.map((row) => row.method));
    const some = (methods) => {
      for (const method of methods) if (present.has(method)) return true;
      return false;
    };
    return trees
      .filter((tree) => tree.possible && tree.needed.every(some))
      .filter((tree) => embed(tree, rows))
      .map((tree) => tree.id);
  }

  /* A state machine whose present state is determined from the called operations of its state modules. */
  class Machine {
    constructor(declared) {
      this.id = declared.id;
      this.declared = declared;
      this.begin();
      this.counts = {};
      this.stateOf = new Map(Object.entries(declared.states).map(([s, module]) => [module, s]));
      this.events = Object.entries(declared.events);
    }

    begin() {
      this.state = this.declared.initial;
    }

    move(to, moves) {
      if (to === this.state) return;
      const edge = `${this.state} ${to}`;
      this.counts[edge] = (this.counts[edge] || 0) + 1;
      moves.push({ machine: this.id, from: this.state, to });
      this.state = to;
    }

    /* Records that an operation of a state module was called: the machine was in the state of this module. If only
       one next state is possible and no transition to it has a guard, the machine then changes to this next state.
       */
    operation(module, method, moves) {
      const state = this.stateOf.get(module);
      if (!state) return;
      const events = this.events.filter(([, operation]) => operation === method);
      if (!events.length) return;
      this.move(state, moves);
      const names = new Set(events.map(([event]) => event));
      const steps = this.declared.transitions.filter(
        ([from, , event]) => from === state && names.has(event),
      );
      const targets = new Set(steps.map(([, to]) => to));
      if (targets.size === 1 && steps.every(([, , , guard]) => !guard)) {
        this.move([...targets][0], moves);
      }
    }
  }

  scope.LiveTrees = { rowsOf, prepared, embed, treesIn, Machine };
  if (typeof module !== "undefined") module.exports = scope.LiveTrees;
})(typeof self !== "undefined" ? self : globalThis);
