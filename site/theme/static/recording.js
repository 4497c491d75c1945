/* Draws the curves of a recording file that the reader chooses in the page. plots.py draws the same curves without a
   browser. */
(function () {
  "use strict";
  const place = document.getElementById("recording");
  const { series, states, topic } = JSON.parse(place.querySelector("[type='application/json']").textContent);
  const one = (name) => place.querySelector(`[data-${name}]`);
  const SVG = "http://www.w3.org/2000/svg";
  const WIDTH = 1000;
  const HEIGHT = 300;
  const TICKS = 5;
  const MS_OF_S = 1000;
  const AT_END = 97; // per cent of the axis; a label beyond this position is aligned with the end of the axis

  // MCAP: the first bytes of a file, the kinds of records, and the offsets of values in a record
  const MAGIC = [0x89, 0x4d, 0x43, 0x41, 0x50, 0x30, 0x0d, 0x0a];
  const [CHANNEL, MESSAGE, CHUNK] = [0x04, 0x05, 0x06];
  const HEAD = 9; // kind and length of a record
  const LENGTH = 4; // length of a text
  const CHANNEL_TOPIC = 4; // the topic is after the numbers of the channel and of its schema
  const MESSAGE_DATA = 22; // the data are after the channel, the sequence number and two times
  const CHUNK_COMPRESSION = 28; // the name of the compression is after two times, the size and the CRC

  /* ---- reading ---- */

  /* Returns the cells of each row of a CSV text. A cell in quotes may contain commas, quotes and line breaks. */
  function cellsOf(text) {
    const lines = [];
    let line = [];
    for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^,\r\n]*))(,|\r?\n|$)/g)) {
      line.push(quoted === undefined ? plain : quoted.replaceAll('""', '"'));
      if (end === ",") continue;
      if (line.length > 1) lines.push(line);
      line = [];
    }
    return lines;
  }

  /* Calls `visit` with the kind and the content of each record of an MCAP file or of one of its chunks. A record has
     one byte for its kind and eight bytes for its length (mcap.dev/spec). If the recording was interrupted, the last
     record is incomplete and is ignored. */
  function visitRecords(bytes, begin, visit) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    let at = begin;
    while (at + HEAD <= bytes.length) {
      const end = at + HEAD + Number(view.getBigUint64(at + 1, true));
      if (end > bytes.length) return;
      visit(bytes[at], bytes.subarray(at + HEAD, end));
      at = end;
    }
  }

  /* Returns the text that begins at a byte, and the byte after this text. */
  function textAt(bytes, begin) {
    const length = new DataView(bytes.buffer, bytes.byteOffset + begin).getUint32(0, true);
    const end = begin + LENGTH + length;
    return [new TextDecoder().decode(bytes.subarray(begin + LENGTH, end)), end];
  }

  /* Returns the decompressed records of a chunk. Throws an error if the compression is neither zstd nor none. */
  function unpacked(chunk) {
    const [compression, end] = textAt(chunk, CHUNK_COMPRESSION);
    const records = chunk.subarray(end + 2 * LENGTH);
    if (compression === "") return records;
    if (compression === "zstd") return fzstd.decompress(records);
    throw new Error(`its compression is ${compression}, and this page reads only zstd`);
  }

  /* Returns the values of each report of an MCAP file. */
  function reportsOf(bytes) {
    const reports = [];
    const channels = new Set();
    const visit = (kind, content) => {
      const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
      if (kind === CHUNK) visitRecords(unpacked(content), 0, visit);
      else if (kind === CHANNEL && textAt(content, CHANNEL_TOPIC)[0] === topic) channels.add(view.getUint16(0, true));
      else if (kind === MESSAGE && channels.has(view.getUint16(0, true)))
        reports.push(JSON.parse(new TextDecoder().decode(content.subarray(MESSAGE_DATA))));
    };
    visitRecords(bytes, MAGIC.length, visit);
    return reports;
  }

  /* Returns the rows of a CSV file with these reports: first the column names, then the cells of each report. */
  function linesOf(reports) {
    const heads = Object.keys(reports[0] || {});
    const cell = (value) => {
      if (value === null || value === undefined) return "";
      if (typeof value === "boolean") return value ? "1" : "0";
      return Array.isArray(value) ? value.join(" ") : String(value);
    };
    return [heads, ...reports.map((report) => heads.map((name) => cell(report[name])))];
  }

  async function readLines(file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    const isMcap = MAGIC.every((byte, i) => bytes[i] === byte);
    return isMcap ? linesOf(reportsOf(bytes)) : cellsOf(new TextDecoder().decode(bytes));
  }

  /* Returns two values: `column`, a function that returns the cells of a named column, and `times`, the time of each
     report since the first report [s]. After a reset, the robot counts its time from 0 again; `times` continues
     without this jump. Returns null if there are no reports or if a necessary column is missing. */
  function tableOf([heads = [], ...lines]) {
    const needed = [
      "time_ms",
      ...states,
      ...series.flatMap((each) => [each.measured, each.set_point, each.quantity]).filter(Boolean),
    ];
    if (!lines.length || needed.some((name) => !heads.includes(name))) return null;
    const column = (name) => lines.map((line) => line[heads.indexOf(name)] || "");
    let offset = 0;
    let last = 0;
    const times = column("time_ms").map((cell) => {
      const at = Number(cell) / MS_OF_S;
      if (at + offset < last) offset = last - at;
      last = at + offset;
      return last;
    });
    return { column, times: times.map((at) => at - times[0]) };
  }

  /* Returns the points of a column: time and value. An empty cell is a missing value and has no point. */
  function pointsOf({ column, times }, name, isDrawn = () => true) {
    return column(name)
      .map((cell, i) => [times[i], cell, i])
      .filter(([, cell, i]) => cell !== "" && isDrawn(i))
      .map(([at, cell]) => [at, Number(cell)]);
  }

  function changesOf({ column, times }) {
    const text = (cell) => (cell === "" ? "none" : Number.isNaN(Number(cell)) ? cell : String(Number(cell) !== 0));
    const found = states.flatMap((name) => {
      const cells = column(name);
      return cells
        .map((cell, i) => ({ at: times[i], name, before: text(cells[i - 1] || ""), after: text(cell), i }))
        .filter(({ i }) => i > 0 && cells[i] !== cells[i - 1]);
    });
    return found.sort((a, b) => a.i - b.i);
  }

  /* ---- drawing ---- */

  const element = (name, attributes, ...content) => {
    const made = document.createElement(name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...content);
    return made;
  };
  const drawn = (name, attributes, ...content) => {
    const made = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => made.setAttribute(key, value));
    made.append(...content);
    return made;
  };

  /* Returns an axis with labels at some round values. If isRounded is true, both ends of the axis are also round
     values. */
  function axisOf(low, high, isRounded) {
    const top = low + (high - low || 1);
    const rough = (top - low) / TICKS;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => size >= rough);
    let [before, after] = [Math.floor(low / step), Math.ceil(top / step)];
    let [first, last] = [low, top];
    if (isRounded) {
      after = Math.max(after, before + 1);
      [first, last] = [before * step, after * step];
    } else [before, after] = [Math.ceil(low / step), Math.floor(top / step)];
    const at = (value) => (value - first) / (last - first);
    const ticks = Array.from({ length: after - before + 1 }, (_, i) => (before + i) * step).map((value) => ({
      text: String(Number(value.toPrecision(6))),
      at: at(value),
    }));
    return { first, last, at, ticks };
  }

  /* Returns the SVG path of a curve. If isStep is true (a set-point), each value applies until the next value.
     Otherwise straight lines connect the values. */
  function pathOf(points, x, y, isStep) {
    const parts = points.map(([at, value], i) => {
      const across = (x.at(at) * WIDTH).toFixed(1);
      const down = (HEIGHT - y.at(value) * HEIGHT).toFixed(1);
      if (!i) return `M${across} ${down}`;
      return isStep ? `H${across}V${down}` : `L${across} ${down}`;
    });
    return parts.join("");
  }

  const labels = (axis, name, unit) =>
    element(
      "div",
      { class: name, "aria-hidden": "true" },
      ...axis.ticks.map(({ text, at }) =>
        element("span", { style: `--at:${(100 * at).toFixed(2)}%`, class: 100 * at > AT_END ? "end" : "" }, text + unit),
      ),
    );

  function figureOf(table, { title, unit, measured, set_point: setPoint, quantity, ordered }) {
    const kinds = quantity ? table.column(quantity) : [];
    const lines = [
      { name: "set-point", kind: "set-point", points: pointsOf(table, setPoint, (i) => !quantity || kinds[i] === ordered) },
      { name: "measured", kind: "measured robot", points: pointsOf(table, measured) },
    ].filter((line) => line.points.length);
    if (!lines.length) return null;
    const all = lines.flatMap((line) => line.points);
    const least = (place_) => all.reduce((found, point) => Math.min(found, point[place_]), Infinity);
    const most = (place_) => all.reduce((found, point) => Math.max(found, point[place_]), -Infinity);
    const x = axisOf(least(0) < 0.2 * most(0) ? 0 : least(0), most(0), false);
    const y = axisOf(Math.min(0, least(1)), Math.max(0, most(1)), true);
    const ends = lines.map(({ name, points }) => `${name} ends at ${Number(points.at(-1)[1].toPrecision(6))}`);
    const drawing = drawn(
      "svg",
      {
        viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
        preserveAspectRatio: "none",
        role: "img",
        "aria-label": `${title} in ${unit}: ${ends.join("; ")}`,
      },
      ...y.ticks.map(({ text, at }) =>
        drawn("path", { class: text === "0" ? "grid zero" : "grid", d: `M0 ${(HEIGHT - at * HEIGHT).toFixed(1)}H${WIDTH}` }),
      ),
      ...lines.map(({ kind, points }) => drawn("path", { class: kind, d: pathOf(points, x, y, kind === "set-point") })),
    );
    const keys = lines.map(({ name, kind }) => {
      const sample = drawn("svg", { viewBox: "0 0 24 8", "aria-hidden": "true" }, drawn("path", { class: kind, d: "M0 4H24" }));
      return element("li", {}, sample, name);
    });
    return element(
      "figure",
      { class: "plot" },
      element("figcaption", {}, `${title} [${unit}]`),
      labels(y, "plot-y", ""),
      drawing,
      labels(x, "plot-x", " s"),
      element("ul", { class: "plot-key" }, ...keys),
    );
  }

  const rowOf = ({ at, name, before, after }) =>
    element(
      "tr",
      {},
      element("td", {}, `${at.toFixed(1)} s`),
      element("td", { "data-l": "value" }, name),
      element("td", { "data-l": "before" }, before),
      element("td", { "data-l": "after" }, after),
    );

  async function show(file) {
    let table = null;
    let reason = "it has no reports in the columns that ./wr monitor --csv writes. See “Other recordings” below.";
    try {
      table = tableOf(await readLines(file));
    } catch (error) {
      reason = `${error.message}. Draw it with ./wr plot FILE.`;
    }
    one("result").hidden = !table;
    one("status").textContent = table
      ? `${file.name}: ${table.times.length} reports in ${table.times.at(-1).toFixed(1)} s.`
      : `${file.name} cannot be drawn: ${reason}`;
    if (!table) return;
    one("plots").replaceChildren(...series.map((each) => figureOf(table, each)).filter(Boolean));
    one("changes").replaceChildren(...changesOf(table).map(rowOf));
  }

  const input = place.querySelector("input");
  const zone = place.querySelector(".drop");
  const mark = (isOver) => zone.classList.toggle("over", isOver);
  input.addEventListener("change", () => input.files[0] && show(input.files[0]));
  zone.addEventListener("dragover", (event) => {
    event.preventDefault();
    mark(true);
  });
  zone.addEventListener("dragleave", () => mark(false));
  zone.addEventListener("drop", (event) => {
    event.preventDefault();
    mark(false);
    if (event.dataTransfer.files[0]) show(event.dataTransfer.files[0]);
  });
})();
