/* The time line of one control cycle. The reader can zoom from the whole cycle (100 ms) to a single call. Without
   this script the page shows a fixed drawing. */
(function () {
  "use strict";
  const source = document.getElementById("timeline-data"),
    place = document.getElementById("timeline");
  if (!source || !place) return;
  const data = JSON.parse(source.textContent),
    live = place.querySelector(".tl-live"),
    base = document.documentElement.dataset.root || "",
    SVG = "http://www.w3.org/2000/svg",
    ROW = 13,
    HEAD = 18,
    AXIS = 22,
    SHORTEST = 500; // the shortest time that the drawing can show [ns]

  /* the calls; each priority has a lane, and each call depth has a row in this lane */
  const calls = [];
  let at = 0;
  data.begins.forEach((step, index) => {
    at += step;
    const activation = data.activations[data.in[index]];
    calls.push({
      index,
      begin: at,
      end: at + data.lengths[index],
      method: data.methods[data.of[index]],
      depth: data.depths[index],
      activation,
      parent: data.parents[index],
    });
  });
  const priorities = [...new Set(data.activations.map((one) => one[1]))].sort(
    (a, b) => (a === null) - (b === null) || a - b,
  );
  const lanes = priorities.map((priority) => ({ priority, rows: [] }));
  calls.forEach((call) => {
    const lane = lanes[priorities.indexOf(call.activation[1])];
    while (lane.rows.length <= call.depth) lane.rows.push([]);
    lane.rows[call.depth].push(call);
  });

  /* the elements of the page: buttons, drawing, and text about the chosen call */
  const make = (name, classes, text) => {
    const element = document.createElement(name);
    if (classes) element.className = classes;
    if (text) element.textContent = text;
    return element;
  };
  const draw = (name, attributes, parent) => {
    const element = document.createElementNS(SVG, name);
    Object.entries(attributes).forEach(([key, value]) => element.setAttribute(key, value));
    parent.append(element);
    return element;
  };
  const tools = make("div", "tl-tools"),
    words = make("span", "tl-window"),
    area = document.createElementNS(SVG, "svg"),
    panel = make("div", "tl-panel"),
    field = make("input");
  area.setAttribute("class", "tl-area");
  area.setAttribute("tabindex", "0");
  area.setAttribute("role", "application");
  area.setAttribute(
    "aria-label",
    "Calls of one control cycle. The keys plus and minus zoom. The left and right arrows move the shown time. The up arrow chooses the caller, and the down arrow the first called method. Enter zooms to the chosen call.",
  );
  panel.setAttribute("aria-live", "polite");
  field.type = "search";
  field.placeholder = "Find a method";
  field.setAttribute("aria-label", "Find the next call of a method");
  const button = (text, label, action) => {
    const element = make("button", "btn", text);
    element.type = "button";
    element.setAttribute("aria-label", label);
    element.addEventListener("click", action);
    tools.append(element);
  };
  button("−", "Zoom out", () => zoom(2));
  button("+", "Zoom in", () => zoom(0.5));
  button("100 ms", "Show the whole cycle", () => show(0, data.length));
  button("main thread", "Show the main thread", () => showCall(first("mainThreadInterrupt")));
  button("‹ call", "Choose the previous call", () => step(-1));
  button("call ›", "Choose the next call", () => step(1));
  tools.append(field, words);
  live.append(tools, area, panel);
  live.hidden = false;
  place.querySelector(".tl-static").hidden = true;

  /* the part of the cycle that is shown */
  let from = 0,
    to = data.length,
    chosen = null,
    asked = 0;
  function show(begin, end) {
    const length = Math.min(data.length, Math.max(SHORTEST, end - begin));
    from = Math.min(Math.max(0, (begin + end - length) / 2), data.length - length);
    to = from + length;
    if (!asked) asked = requestAnimationFrame(render);
  }
  function zoom(factor, middle) {
    const centre = middle === undefined ? centreOf() : middle;
    show(centre - (centre - from) * factor, centre + (to - centre) * factor);
  }
  const centreOf = () =>
    chosen && chosen.begin < to && chosen.end > from
      ? (Math.max(from, chosen.begin) + Math.min(to, chosen.end)) / 2
      : (from + to) / 2;
  const first = (name) => calls.find((call) => call.method[0] === name);
  function showCall(call) {
    if (!call) return;
    choose(call);
    const length = Math.max(call.end - call.begin, 100);
    show(call.begin - 0.06 * length, call.end + 0.06 * length);
  }
  function step(by) {
    const next = calls[chosen ? chosen.index + by : 0];
    if (!next) return;
    choose(next);
    const length = to - from;
    if (next.begin < from || next.begin > to)
      show(next.begin - length / 2, next.begin + length / 2);
  }

  /* drawing */
  const time = (ns) =>
    Math.abs(ns) < 1e3
      ? ns.toFixed(0) + " ns"
      : Math.abs(ns) < 1e6
        ? Number((ns / 1e3).toFixed(2)) + " µs"
        : Number((ns / 1e6).toFixed(4)) + " ms";
  function render() {
    asked = 0;
    const width = Math.max(280, live.clientWidth),
      scale = width / (to - from),
      x = (ns) => (ns - from) * scale;
    area.replaceChildren();
    let top = AXIS;
    axis(width, x);
    lanes.forEach((lane, number) => {
      const group = draw("g", { class: "lane" + number }, area);
      const names = new Set();
      // If all calls of a row are too short for a bar, the rows of their nested calls are not drawn.
      let depth = 0;
      while (depth < lane.rows.length) {
        const y = top + HEAD + depth * ROW;
        depth += 1;
        if (!drawRow(group, lane.rows[depth - 1], y, x, names)) break;
      }
      const title = lane.priority === null ? "idle program" : "priority " + lane.priority;
      const name = draw("text", { class: "tl-name", x: 6, y: top + 13 }, group);
      fit(name, title, [...names].filter((each) => each !== title), width - 12);
      top += HEAD + depth * ROW + 4;
      draw("path", { class: "tl-base", d: "M0 " + top + "H" + width }, area);
    });
    area.setAttribute("viewBox", "0 0 " + width + " " + (top + 2));
    area.setAttribute("height", top + 2);
    words.textContent = time(from) + " to " + time(to) + ", " + time(to - from) + " shown";
  }
  /* Writes the title of a lane, followed by as many names as the width permits. */
  function fit(text, title, names, width) {
    for (let count = names.length; count >= 0; count -= 1) {
      const rest = names.length - count;
      const list = [...names.slice(0, count), ...(rest ? [`${rest} more`] : [])].join(", ");
      text.textContent = list ? `${title}: ${list}` : title;
      if (text.getComputedTextLength() <= width) return;
    }
    text.textContent = title;
  }
  function axis(width, x) {
    const rough = ((to - from) * 110) / width,
      power = 10 ** Math.floor(Math.log10(rough)),
      unit = [1, 2, 5, 10].map((n) => n * power).find((n) => n >= rough);
    for (let tick = Math.ceil(from / unit) * unit; tick <= to; tick += unit) {
      draw("path", { class: "tl-base", d: "M" + x(tick).toFixed(1) + " 0V" + AXIS }, area);
      const text = draw("text", { class: "tl-tick", x: x(tick) + 3, y: 13 }, area);
      text.textContent = time(tick);
    }
  }
  function drawRow(group, row, y, x, names) {
    let low = 0,
      high = row.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (row[middle].end < from) low = middle + 1;
      else high = middle;
    }
    let dust = null,
      drawn = false;
    const flush = () => {
      if (dust)
        draw(
          "rect",
          {
            class: "tl-dust",
            x: dust[0].toFixed(1),
            y: y + 1,
            width: Math.max(1, dust[1] - dust[0]).toFixed(1),
            height: ROW - 3,
          },
          group,
        );
      dust = null;
    };
    for (let i = low; i < row.length && row[i].begin <= to; i++) {
      const call = row[i],
        left = Math.max(-2, x(call.begin)),
        right = Math.min(x(to) + 2, x(call.end));
      names.add(call.activation[0]);
      if (right - left < 1.5 && call !== chosen) {
        if (dust && left - dust[1] < 1) dust[1] = Math.max(dust[1], right);
        else {
          flush();
          dust = [left, right];
        }
        continue;
      }
      flush();
      drawn = true;
      const bar = draw(
        "rect",
        {
          class: "tl-bar" + (call === chosen ? " chosen" : ""),
          x: left.toFixed(1),
          y: y + 0.5,
          width: Math.max(1, right - left).toFixed(1),
          height: ROW - 2,
          "data-call": call.index,
        },
        group,
      );
      draw("title", {}, bar).textContent = call.method[0] + ", " + time(call.end - call.begin);
      label(group, call.method[0], left, right, y);
    }
    flush();
    return drawn;
  }
  function label(group, name, left, right, y) {
    const begin = Math.max(0, left),
      room = Math.floor((right - begin - 6) / 6);
    if (room < 4) return;
    const short = name.length > room && name.includes("::") ? name.split("::").pop() : name;
    const text = draw("text", { x: begin + 3, y: y + 9.5 }, group);
    text.textContent = short.length > room ? short.slice(0, room - 1) + "…" : short;
  }

  /* the chosen call */
  const link = (href, text) => {
    if (!href) return make("span", "", text);
    const element = make("a", "", text);
    element.href = href.replace(/^@\//, base);
    return element;
  };
  function choose(call) {
    chosen = call;
    const [name, page, code, requirements] = call.method,
      [context, priority, raised, begin] = call.activation,
      head = make("p"),
      when = make("p"),
      above = make("p"),
      trees = make("p");
    head.append(make("b", "", name), " ");
    if (code) head.append(link(code, "source"), " ");
    if (page) head.append(link(page, "interface"));
    when.textContent =
      "begins " + time(call.begin) + " after the clock pulse, lasts " + time(call.end - call.begin) +
      "; runs in: " + context + (priority === null ? "" : ", priority " + priority) +
      (begin > raised ? ", which started " + time(begin - raised) + " after its request" : "");
    const callers = [];
    for (let up = calls[call.parent]; up; up = calls[up.parent]) callers.unshift(up);
    if (callers.length) above.append("called by ");
    callers.slice(-4).forEach((up, number) => {
      if (number) above.append(" › ");
      const element = make("button", "linkish", up.method[0]);
      element.type = "button";
      element.addEventListener("click", () => showCall(up));
      above.append(element);
    });
    trees.append(requirements.length ? "in the invocation trees of " : "in no invocation tree");
    requirements.forEach((id, number) => {
      if (number) trees.append(", ");
      trees.append(link("@/requirements/" + id + ".html#tree", id));
    });
    panel.replaceChildren(head, when, ...(callers.length ? [above] : []), trees);
    history.replaceState(null, "", "#call-" + call.index);
    if (!asked) asked = requestAnimationFrame(render);
  }

  /* pointer and keys */
  let dragged = null;
  area.addEventListener("pointerdown", (event) => {
    dragged = { x: event.clientX, from, to, moved: false };
  });
  area.addEventListener("pointermove", (event) => {
    if (!dragged || !event.buttons) return;
    const by = ((event.clientX - dragged.x) * (dragged.to - dragged.from)) / area.clientWidth;
    if (Math.abs(event.clientX - dragged.x) > 4) dragged.moved = true;
    if (dragged.moved) show(dragged.from - by, dragged.to - by);
  });
  area.addEventListener("click", (event) => {
    const bar = event.target.closest("[data-call]");
    if (bar && !(dragged && dragged.moved)) choose(calls[bar.dataset.call]);
  });
  area.addEventListener("dblclick", (event) => {
    const bar = event.target.closest("[data-call]");
    if (bar) showCall(calls[bar.dataset.call]);
    else zoom(0.5, from + ((to - from) * event.offsetX) / area.clientWidth);
  });
  area.addEventListener(
    "wheel",
    (event) => {
      if (!event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      zoom(event.deltaY > 0 ? 1.25 : 0.8, from + ((to - from) * event.offsetX) / area.clientWidth);
    },
    { passive: false },
  );
  area.addEventListener("keydown", (event) => {
    const below = () => chosen && calls.find((call) => call.parent === chosen.index);
    const actions = {
      "+": () => zoom(0.5),
      "=": () => zoom(0.5),
      "-": () => zoom(2),
      ArrowLeft: () => show(from - (to - from) / 5, to - (to - from) / 5),
      ArrowRight: () => show(from + (to - from) / 5, to + (to - from) / 5),
      ArrowUp: () => chosen && calls[chosen.parent] && choose(calls[chosen.parent]),
      ArrowDown: () => below() && choose(below()),
      Enter: () => showCall(chosen),
      Home: () => show(0, data.length),
    };
    if (!actions[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    actions[event.key]();
  });
  field.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" || !field.value) return;
    const wanted = field.value.toLowerCase(),
      begin = chosen ? chosen.index + 1 : 0,
      order = [...calls.slice(begin), ...calls.slice(0, begin)];
    showCall(order.find((call) => call.method[0].toLowerCase().includes(wanted)));
  });
  window.addEventListener("resize", () => show(from, to));

  const asks = /^#call-(\d+)$/.exec(location.hash);
  panel.append(
    make("p", "", "When you choose a call, its method, its source and its requirements appear here. A double click zooms to the call."),
  );
  show(0, data.length);
  if (asks) showCall(calls[asks[1]]);
})();
