/* The class LiveModule: the functions of the WebAssembly module that contains the virtual board and the simulated
   robot. The page uses the class in a worker, and the tests use it in Node. */
(function (scope) {
  "use strict";

  const TEXT = { thrown: 0, failures: 1, finding: 2, names: 3, reports: 4 };
  const STATES = ["runs", "ended", "found"];
  const OPTION = { resets: 1, verify: 2 };

  /* Returns the WASI functions that the module imports. The module has no files and no environment variables. Each
   * function that is not defined here returns 0. */
  function system(module) {
    const none = () => 0;
    return new Proxy(
      {
        environ_sizes_get(count, size) {
          const view = new DataView(module.exports.memory.buffer);
          view.setUint32(count, 0, true);
          view.setUint32(size, 0, true);
          return 0;
        },
        proc_exit(code) {
          throw new Error("the module ended with code " + code);
        },
      },
      { get: (known, name) => known[name] || none },
    );
  }

  class LiveModule {
    constructor(compiled) {
      const instance = { exports: null };
      const made = new WebAssembly.Instance(compiled, {
        wasi_snapshot_preview1: system(instance),
      });
      instance.exports = this.exports = made.exports;
      this.exports._initialize();
    }

    /* Calls an exported function of the module. If this function throws a C++ exception, call() throws a JavaScript
     * error with the text of the exception. */
    call(name, ...values) {
      try {
        return this.exports[name](...values);
      } catch (error) {
        const text = name === "liveText" ? "" : this.text("thrown");
        throw new Error(text || String(error.message || error));
      }
    }

    put(bytes) {
      const at = this.call("liveAlloc", bytes.length);
      new Uint8Array(this.exports.memory.buffer).set(bytes, at);
      return at;
    }

    withText(name, text) {
      const bytes = new TextEncoder().encode(text);
      const at = this.put(bytes);
      try {
        this.call(name, at, bytes.length);
      } finally {
        this.exports.liveFree(at);
      }
    }

    kept() {
      const { memory, liveBytes: begin, liveSize: size } = this.exports;
      return new Uint8Array(memory.buffer, begin(), size()).slice();
    }

    text(name) {
      this.call("liveText", TEXT[name]);
      return new TextDecoder().decode(this.kept());
    }

    start({ image, functions = [], scenario, resets = false, verify = false }) {
      const text = new TextEncoder().encode(scenario);
      const addresses = new Uint8Array(Uint32Array.from(functions).buffer);
      const places = [this.put(image), this.put(addresses), this.put(text)];
      const options = (resets ? OPTION.resets : 0) | (verify ? OPTION.verify : 0);
      const [at, functionsAt, textAt] = places;
      this.call(
        "liveStart",
        at,
        image.length,
        functionsAt,
        functions.length,
        textAt,
        text.length,
        options,
      );
      places.forEach((place) => this.exports.liveFree(place));
      this.functions = functions.length;
      this.names = this.names || this.text("names").split(",");
    }

    cycle() {
      return STATES[this.call("liveCycle")];
    }

    runToEnd() {
      return STATES[this.call("liveRunToEnd")];
    }

    perform(action) {
      this.withText("livePerform", action);
    }

    repeat(order) {
      this.withText("liveRepeat", order);
    }

    /* Returns the present values of the simulation, for example time_ms. The keys are the names of the values. */
    numbers() {
      const at = this.call("liveNumbers");
      const values = new Float64Array(this.exports.memory.buffer, at, this.names.length);
      return Object.fromEntries(this.names.map((name, i) => [name, values[i]]));
    }

    report() {
      this.call("liveReport");
      return this.kept();
    }

    callsHash() {
      return this.call("liveCallsHash") >>> 0;
    }

    calls() {
      const at = this.call("liveCalls");
      const count = this.call("liveCallCount");
      return new Uint32Array(this.exports.memory.buffer, at, count).slice();
    }

    entries() {
      const at = this.call("liveEntries");
      return new Uint32Array(this.exports.memory.buffer, at, this.functions).slice();
    }

    /* Returns the last call of each function: the time of the call [ns], and the core registers r0 to r3 when the
       call begins. */
    lastCalls() {
      this.call("liveLastCalls");
      const bytes = this.kept();
      const view = new DataView(bytes.buffer);
      return Array.from({ length: this.functions }, (_, i) => ({
        at: Number(view.getBigInt64(24 * i, true)),
        registers: [8, 12, 16, 20].map((offset) => view.getUint32(24 * i + offset, true)),
      }));
    }

    /* Returns the entries and exits of the interrupts and threads in the last cycle, the earliest first. Times are in
     * ns. */
    switches() {
      this.call("liveSwitches");
      const bytes = this.kept();
      const view = new DataView(bytes.buffer);
      return Array.from({ length: bytes.length / 7 }, (_, i) => ({
        exception: view.getUint16(7 * i, true),
        entered: view.getUint8(7 * i + 2) === 1,
        at: view.getUint32(7 * i + 3, true),
      }));
    }

    /* Returns the pieces of data that were sent on the serial line since the last call of line(). Each piece has its
     * time [ms], its direction and its bytes. */
    line() {
      this.call("liveLine");
      const bytes = this.kept();
      const view = new DataView(bytes.buffer);
      const pieces = [];
      for (let at = 0; at < bytes.length;) {
        const size = view.getUint32(at + 9, true);
        pieces.push({
          at: Number(view.getBigUint64(at, true)) / 1000,
          fromPc: bytes[at + 8] === 1,
          bytes: bytes.slice(at + 13, at + 13 + size),
        });
        at += 13 + size;
      }
      return pieces;
    }

    events() {
      const hash = BigInt.asUintN(64, this.call("liveEventHash"));
      return { count: this.call("liveEventCount"), hash: hash.toString(16).padStart(16, "0") };
    }
  }

  /* Plays a scenario to its end. Returns the events and the reports of this run, so that a test can compare them with
   * the same scenario on another target. */
  LiveModule.play = function (compiled, image, scenario) {
    const module = new LiveModule(compiled);
    module.start({ image, scenario, verify: true });
    const begin = performance.now();
    const end = module.runToEnd();
    const seconds = (performance.now() - begin) / 1000;
    return {
      end,
      failures: module.text("failures"),
      events: module.events(),
      reports: module.text("reports"),
      factor: module.numbers().time_ms / 1000 / seconds,
    };
  };

  scope.LiveModule = LiveModule;
  if (typeof module !== "undefined") module.exports = { LiveModule };
})(typeof self !== "undefined" ? self : globalThis);
