/* The web worker that runs the simulated robot for a page. It runs one control cycle after another at the chosen speed,
   and sends a snapshot to the page at most 20 times per second. */
"use strict";
importScripts("module.js", "trees.js", "frames.js");

const SLICE = 50; // ms between snapshots
const BUSY = 40; // ms; part of each SLICE in which the worker runs cycles
const CYCLE = 100; // ms; length of a control cycle in the time of the robot
const SECOND = 1000 / CYCLE; // number of control cycles in one second
const SHOWN_FRAMES = 24;
const PAPER = "weeding_robot_paper";
const DEFAULT = "weeding_robot";

let facts, compiled, product, trees, report, machines, line;
let simulator = null;
let robot = null;

const asBytes = async (path) => {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path} could not be loaded (HTTP status ${answer.status})`);
  return new Uint8Array(await answer.arrayBuffer());
};

async function load(folder) {
  const begin = performance.now();
  const [wasm, data] = await Promise.all([asBytes(`${folder}live.wasm`), fetch(`${folder}live.json`)]);
  compiled = await WebAssembly.compile(wasm);
  facts = await data.json();
  report = facts.frames.find((frame) => frame.name === "Report");
  return performance.now() - begin;
}

async function choose(folder, name) {
  if (product && product.name === name) return;
  product = facts.products.find((one) => one.name === name);
  product.bytes = product.bytes || (await asBytes(`${folder}${name}.bin`));
  product.methodAt = new Map(product.functions);
  product.has = new Set(product.functions.map(([, method]) => method));
  trees = facts.trees
    .filter((tree) => tree.products.includes("all") || tree.products.includes(product.product) || !tree.products.length)
    .map((tree) => LiveTrees.prepared(tree, product.has));
}

/* A simulated robot in the WebAssembly module, and the records of one run of this robot. */
class Robot {
  constructor(scenario, log) {
    this.scenario = scenario;
    this.log = log; // manual actions: [time, kind, text]
    this.next = 0; // index of the next action in the log
    simulator = simulator || new LiveModule(compiled);
    simulator.start({
      image: product.bytes,
      functions: product.functions.map(([address]) => address),
      scenario: scenario.text,
      resets: true,
    });
    line = new LiveFrames.Line(facts.frames);
    machines = facts.machines.map((one) => new LiveTrees.Machine(one));
    this.hardware = new Set(facts.hardware);
    this.known = new Map(); // hash of the calls of a cycle -> the trees that these calls match
    this.seen = {}; // requirement -> number of cycles that contained its invocation tree, and the first of these cycles
    this.state = "runs";
    this.rows = [];
    this.rowsHash = 0;
    this.entries = []; // for each of the last cycles: the number of calls of each function until the end of this cycle
    this.clear();
  }

  /* Clears the records that were already sent to the page. */
  clear() {
    this.history = [];
    this.frames = [];
    this.moves = [];
    this.fresh = [];
  }

  time() {
    return simulator.numbers().time_ms;
  }

  act(kind, text, at) {
    try {
      if (kind === "order") simulator.repeat(text);
      else simulator.perform(text);
    } catch (error) {
      post({ kind: "refused", text, why: String(error.message) });
      simulator = null;
      return;
    }
    if (at !== undefined) return;
    this.log.splice(this.next); // after a step back in time, a new action replaces the later actions
    this.log.push([this.time(), kind, text]);
    this.next = this.log.length;
  }

  repeatLog() {
    while (this.next < this.log.length && this.log[this.next][0] <= this.time()) {
      const [at, kind, text] = this.log[this.next];
      this.next += 1;
      this.act(kind, text, at);
    }
  }

  cycle() {
    if (this.state !== "runs") return false;
    this.repeatLog();
    this.state = simulator.cycle();
    const numbers = simulator.numbers();
    if (this.numbers && numbers.resets !== this.numbers.resets)
      machines.forEach((machine) => machine.begin());
    this.numbers = numbers;
    this.values = LiveFrames.valuesOf(simulator.report(), report);
    this.entries.push(simulator.entries());
    this.entries.splice(0, this.entries.length - SECOND - 1);
    this.readCalls(numbers.time_ms);
    this.readLine();
    this.history.push(this.point(numbers));
    return this.state === "runs";
  }

  readCalls(now) {
    const hash = simulator.callsHash();
    const moves = [];
    let found = this.known.get(hash);
    this.rows = LiveTrees.rowsOf(simulator.calls(), product.methodAt, this.hardware);
    this.rowsHash = hash;
    if (found === undefined) {
      found = LiveTrees.treesIn(trees, this.rows);
      this.known.set(hash, found);
    }
    for (const row of this.rows) {
      const [owner, method] = facts.methods[row.method].split("::");
      machines.forEach((machine) => machine.operation(owner, method, moves));
    }
    this.moves.push(...moves.map((move) => ({ ...move, at: now })));
    this.stopsAt = null;
    for (const id of found) {
      if (!this.seen[id]) {
        this.seen[id] = { count: 0, at: now, cycle: this.numbers.pulses };
        this.fresh.push(id);
      }
      this.seen[id].count += 1;
      if (watched.has(id)) this.stopsAt = id;
    }
  }

  readLine() {
    this.frames.push(...line.take(simulator.line()));
    this.frames.splice(0, Math.max(0, this.frames.length - SHOWN_FRAMES));
  }

  point(numbers) {
    const { values } = this;
    return { t: numbers.time_ms, v: values, n: numbers };
  }
}

let watched = new Set();
let speed = 1;
let running = false;
let target = 0;
let last = 0;
let timer = 0;

function post(message) {
  self.postMessage(message);
}

function snapshot() {
  if (!robot || !robot.numbers) return;
  const treeRows = robot.rows.map((row) => [row.method, row.depth, row.activation, row.parent]);
  post({
    kind: "snapshot",
    running,
    state: robot.state,
    numbers: robot.numbers,
    values: robot.values,
    history: robot.history,
    frames: robot.frames.map((frame) => ({ ...frame, values: line.values(frame) })),
    moves: robot.moves,
    machines: machines.map(({ id, state, counts }) => ({ id, state, counts: { ...counts } })),
    seen: robot.seen,
    fresh: robot.fresh,
    found: robot.known.get(robot.rowsHash) || [],
    stopsAt: running ? null : robot.stopsAt,
    entries: robot.entries[robot.entries.length - 1],
    before: robot.entries[0],
    rows: treeRows,
    failures: simulator ? simulator.text("failures") : "",
    finding: simulator ? simulator.text("finding") : "",
    hands: robot.log.length,
  });
  robot.clear();
}

function pause() {
  running = false;
  clearTimeout(timer);
}

function tick() {
  const now = performance.now();
  target += (now - last) * speed;
  last = now;
  const end = now + BUSY;
  let cycles = 0;
  while (running && (speed === Infinity || robot.time() < target) && performance.now() < end) {
    cycles += 1;
    if (!robot.cycle() || robot.stopsAt) running = false;
  }
  if (robot.time() < target - CYCLE) target = robot.time(); // the computer of the reader is too slow for this speed
  if (cycles) snapshot();
  if (running) timer = setTimeout(tick, Math.max(0, SLICE - (performance.now() - now)));
  else snapshot();
}

function run() {
  if (running || !robot || robot.state !== "runs") return;
  running = true;
  last = performance.now();
  target = robot.time() + CYCLE;
  tick();
}

/* Runs without pauses until a time of the robot [ms]. The page requests this when the reader opens a link to an instant
   or moves the slider of the time line. */
function seek(time) {
  let wanted = time;
  const end = performance.now() + 60000;
  while (robot.time() < wanted && robot.cycle() && performance.now() < end);
  snapshot();
}

/* Plays one scenario after the other, until a cycle contains the invocation tree of a requirement. */
async function find({ folder, id }) {
  pause();
  for (const scenario of facts.scenarios) {
    await choose(folder, `${scenario.product}_calls`);
    const tree = trees.find((one) => one.id === id);
    if (!tree || !tree.possible) continue;
    post({ kind: "plays", title: scenario.title });
    robot = new Robot(scenario, []);
    let goesOn = true;
    while (goesOn && !robot.seen[id]) {
      robot.clear();
      goesOn = robot.cycle();
    }
    if (robot.seen[id]) {
      const placed = LiveTrees.embed(tree, robot.rows).sort((a, b) => a - b);
      const base = Math.min(...placed.map((index) => robot.rows[index].depth));
      post({
        kind: "found",
        product: product.name,
        scenario: scenario.name,
        title: scenario.title,
        at: robot.seen[id].at,
        cycle: robot.seen[id].cycle,
        moves: robot.moves,
        calls: placed.map((index) => ({
          name: facts.methods[robot.rows[index].method],
          depth: robot.rows[index].depth - base,
        })),
        nodes: lastCallsOf(tree.root, new Set(placed.map((index) => robot.rows[index].method))),
      });
      return;
    }
  }
  post({ kind: "found" });
}

/* Returns the last call of each node of an invocation tree: the time [ms] and the arguments of the call. The nodes
   are in the order of the tree. */
function lastCallsOf(root, called) {
  const calls = simulator.lastCalls();
  const nodesIn = (node) => [node, ...node.children.flatMap(nodesIn)];
  return nodesIn(root).map(({ name, methods }) => {
    const made = product.functions
      .map(([, method], i) => ({ method, ...calls[i] }))
      .filter(({ method, at }) => methods.has(method) && called.has(method) && at >= 0)
      .sort((a, b) => b.at - a.at);
    return made.length ? { name, at: made[0].at / 1e6, values: argumentsOf(made[0]) } : { name };
  });
}

/* Returns the arguments of a call as texts. The core registers contain the arguments in the order of the parameters.
   */
function argumentsOf({ method, registers }) {
  const SIZES = { bool: 1, i8: 8, u8: 8, i16: 16, u16: 16, i32: 32, u32: 32 };
  const { first, parameters } = facts.parameters[method] || { first: 0, parameters: [] };
  return parameters.slice(0, registers.length - first).map(([name, kind], i) => {
    const value = registers[first + i];
    if (kind === "address") return `${name} at 0x${value.toString(16).padStart(8, "0")}`;
    const unused = 32 - SIZES[kind];
    const number = kind[0] === "i" ? (value << unused) >> unused : (value << unused) >>> unused;
    return `${name} = ${kind === "bool" ? number === 1 : number}`;
  });
}

/* Returns the name of the firmware image that contains the most of the given modules. If several images contain
   the same number of these modules, the function prefers the paper's design, then the default product. */
function imageWith(modules) {
  const modulesOf = (one) => new Set(one.functions.map(([, method]) => ownerOf(method)));
  const held = (one) => modules.filter((name) => modulesOf(one).has(name)).length;
  const rank = (one) => [PAPER, DEFAULT].indexOf(one.product) + 1 || 3;
  const sorted = facts.products.filter((one) => !one.flashed).sort((a, b) => held(b) - held(a) || rank(a) - rank(b));
  return sorted[0].name;
}

const ownerOf = (method) => facts.methods[method].split("::")[0];

/* The modules that the page shows while a scenario plays, and the present number of calls of each module. */
let shown = { modules: new Set(), counts: {} };

/* Prepares a scenario for a page that shows modules. Each later message "playCycle" from the page runs one control
   cycle of the scenario. */
async function play({ folder, modules, scenario: wanted, image }) {
  pause();
  await choose(folder, image || imageWith(modules));
  const usual = product.functions.some(([, method]) => ownerOf(method) === "ProtectiveStop") ? "hall_dead" : "loss_of_the_pc";
  const named = (name) => facts.scenarios.find((one) => one.name === name);
  const scenario = named(wanted) || named(usual) || facts.scenarios[0];
  robot = new Robot(scenario, []);
  shown = { modules: new Set(modules), counts: countsOf(modules) };
  post({
    kind: "plays",
    title: scenario.title,
    scenario: scenario.name,
    product: product.name,
    scenarios: facts.scenarios.map(({ name, title }) => ({ name, title })),
  });
}

/* Returns, for each given module, the number of calls since the start of the scenario. */
function countsOf(modules) {
  const entries = simulator.entries();
  const counts = Object.fromEntries([...modules].map((name) => [name, 0]));
  product.functions.forEach(([, method], i) => {
    const name = ownerOf(method);
    if (name in counts) counts[name] += entries[i];
  });
  return counts;
}

/* Returns the pairs [caller, called module] of the last cycle, for calls between two different shown modules. */
function callsBetween(modules) {
  const found = new Set();
  robot.rows.forEach((row) => {
    if (row.parent < 0) return;
    const [from, to] = [ownerOf(robot.rows[row.parent].method), ownerOf(row.method)];
    if (from !== to && modules.has(from) && modules.has(to)) found.add(`${from} ${to}`);
  });
  return [...found].map((pair) => pair.split(" "));
}

/* State machine -> the field of the report that contains the state of this machine. */
const REPORTED = { "operation-states": "state", "reading-modes": "mode" };

function nameOf(field, number) {
  const found = report.fields.find((one) => one.n === field);
  return (found && found.v && found.v[number]) || String(number);
}

/* Returns the present state of each state machine, and the module that implements this state. */
function presentStates() {
  const reported = robot.numbers.reports > 0;
  return machines.map(({ id, state: inferred, declared }) => {
    const field = REPORTED[id];
    const state = reported && field ? nameOf(field, robot.values[field]) : inferred;
    return { id, state, module: declared.states[state] || state };
  });
}

function playCycle() {
  if (!robot) return;
  const { modules, counts: before } = shown;
  robot.clear();
  const goesOn = robot.cycle();
  const counts = countsOf(modules);
  shown.counts = counts;
  post({
    kind: "playCycle",
    goesOn,
    at: robot.numbers.time_ms,
    cycle: robot.numbers.pulses,
    speed: robot.numbers.ground_speed,
    counts,
    active: Object.keys(counts).filter((name) => counts[name] > before[name]),
    calls: callsBetween(modules),
    states: presentStates(),
    moves: robot.moves,
    frames: robot.frames,
    lasted: robot.numbers.cycle_us * 1000, // ns
    switches: simulator.switches(),
  });
}

/* Plays one scenario with several products. Sends to the page, for each product, the states in each cycle and the
   modules that ran. */
async function compare({ folder, products, scenario: name }) {
  pause();
  const scenario = facts.scenarios.find((one) => one.name === name);
  const runs = [];
  for (const wanted of products) {
    await choose(folder, `${wanted}_calls`);
    post({ kind: "plays", title: scenario.title, product: wanted });
    robot = new Robot(scenario, []);
    const cycles = [];
    let goesOn = true;
    while (goesOn) {
      robot.clear();
      goesOn = robot.cycle();
      const states = presentStates().filter(({ id }) => id in REPORTED);
      cycles.push({ at: robot.numbers.time_ms, speed: robot.numbers.ground_speed, states });
    }
    const counts = countsOf(new Set(product.functions.map(([, method]) => ownerOf(method))));
    const modules = facts.modules.map((one) => one.name).filter((one) => counts[one] > 0);
    runs.push({ product: wanted, cycles, modules });
  }
  post({ kind: "compared", title: scenario.title, runs });
}

const ORDERS = {
  compare,
  play,
  playCycle,
  async load({ folder }) {
    const ms = await load(folder);
    post({ kind: "loaded", ms, facts });
  },
  async start({ folder, name, scenario, time, log }) {
    pause();
    await choose(folder, name);
    robot = new Robot(scenario, log || []);
    const possible = trees.filter((tree) => tree.possible).length;
    post({ kind: "started", possible, trees: trees.length });
    robot.cycle();
    seek(time || 0);
  },
  find,
  run,
  pause() {
    pause();
    snapshot();
  },
  cycle() {
    pause();
    robot.cycle();
    snapshot();
  },
  speed({ value }) {
    speed = value;
    if (running) target = robot.time() + CYCLE;
  },
  act({ how, text }) {
    robot.act(how, text);
  },
  watch({ ids }) {
    watched = new Set(ids);
  },
  seek({ time }) {
    pause();
    if (time < robot.time()) {
      const { scenario, log } = robot;
      robot = new Robot(
        scenario,
        log.filter(([at]) => at <= time),
      );
      post({ kind: "again" });
    }
    seek(time);
  },
};

/* The queue of the messages from the page. The worker handles a message only when it has finished the previous message,
   because some messages wait for a file. */
let orders = Promise.resolve();

async function obey(data) {
  try {
    await ORDERS[data.do](data);
  } catch (error) {
    pause();
    simulator = null;
    post({ kind: "error", text: String(error.message || error) });
  }
}

self.onmessage = ({ data }) => {
  orders = orders.then(() => obey(data));
};
