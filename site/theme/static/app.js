/* The script of all pages: theme, menu, search, module cards, letter keys and list filters. The reader can read the
   pages without this script. */
(function () {
  "use strict";
  const one = (selector, root) => (root || document).querySelector(selector);
  const all = (selector, root) => [...(root || document).querySelectorAll(selector)];
  const data = window.PORTAL || { modules: {}, commit: "" };
  const base = document.documentElement.dataset.root || "";
  const escape = (text) =>
    String(text).replace(
      /[&<>"]/g,
      (c) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c],
    );

  /* theme */
  const html = document.documentElement,
    button = one(".theme"),
    themes = ["auto", "light", "dark"];
  const theme = () => html.dataset.theme || "auto";
  function sayTheme() {
    const t = theme();
    one("span", button).textContent = t[0].toUpperCase() + t.slice(1);
    button.setAttribute("aria-label", "Theme: " + t);
  }
  button.addEventListener("click", () => {
    const next = themes[(themes.indexOf(theme()) + 1) % 3];
    if (next === "auto") delete html.dataset.theme;
    else html.dataset.theme = next;
    try {
      localStorage.setItem("theme", next);
    } catch (error) {
      /* Without storage, the choice is valid only for this page. */
    }
    sayTheme();
  });
  sayTheme();

  /* shows the number of the commit, and opens and closes the menu in narrow windows */
  const commit = one("[data-commit]");
  if (data.commit) {
    one("code", commit).textContent = data.commit.slice(0, 7);
    commit.hidden = false;
  }
  const menu = one(".menu"),
    side = one("#side");
  function showMenu(open) {
    side.classList.toggle("open", open);
    menu.setAttribute("aria-expanded", open);
    (open ? side : menu).focus();
  }
  menu.addEventListener("click", () => showMenu(!side.classList.contains("open")));
  side.addEventListener("keydown", (event) => {
    if (event.key === "Escape" && side.classList.contains("open")) showMenu(false);
  });
  if (window.matchMedia("(max-width: 820px)").matches)
    all(".calls-list, .trace-list").forEach((list) => {
      list.open = true;
    });

  /* the Tab key stops only at the first view key of a module; the arrow keys move to its other view keys */
  const VIEWS = [
    ["F", "Diagram", "diagram"],
    ["I", "Interface", "interface"],
    ["G", "Guide", "guide"],
    ["P", "Patterns", "patterns"],
    ["R", "Requirements", "requirements"],
    ["S", "Source", "source"],
    ["T", "Tests", "tests"],
  ];
  const viewOf = (name, section) => base + data.modules[name].url + "#" + section;
  all(".vk").forEach((group) =>
    all("a", group).forEach((key, i) => {
      key.tabIndex = i ? -1 : 0;
    }),
  );
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && event.key === "k") {
      one("#q").focus();
      one("#q").select();
      event.preventDefault();
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target,
      group = target.closest(".vk"),
      inCard = target.closest(".card");
    if (group && /^Arrow(Left|Right)$/.test(event.key)) {
      const keys = all("a", group),
        next = keys[keys.indexOf(target) + (event.key === "ArrowRight" ? 1 : -1)];
      if (next) next.focus();
      event.preventDefault();
      return;
    }
    /* the arrow keys move the focus from the name of a module into its card, and in the card from view to view */
    if (card && (target === owner || inCard) && /^Arrow(Down|Up|Left|Right)$/.test(event.key)) {
      const views = all("a", card),
        step = /Down|Right/.test(event.key) ? 1 : -1,
        next = views[inCard ? views.indexOf(target) + step : 0];
      if (next) next.focus();
      event.preventDefault();
      return;
    }
    /* a letter key opens a view only while the name of a module, its view keys or its card has the focus */
    const name = target.dataset.m || (group && group.dataset.vk) || (inCard && inCard.dataset.m);
    const view =
      name &&
      data.modules[name] &&
      VIEWS.find(
        (v) => v[0] === event.key.toUpperCase() && data.modules[name].views.includes(v[0]),
      );
    if (view) {
      location.href = viewOf(name, view[2]);
      event.preventDefault();
      return;
    }
    if (event.key === "/" && !/^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName)) {
      one("#q").focus();
      event.preventDefault();
    }
    if (event.key === "Escape") {
      const back = hide(); // the name gets the focus again, and its card stays closed
      silent = true;
      if (back) back.focus();
      silent = false;
    }
  });

  /* each link to a module in a drawing gets the attribute data-m with the name of this module */
  all("svg a[href]").forEach((link) => {
    const name = (link.getAttribute("href").match(/(?:^|\/)modules\/(\w+)\.html$/) || [])[1];
    if (name && data.modules[name]) link.dataset.m = name;
  });

  /* When the reader points at the box or at a table row of a module, the box and its table rows are highlighted. The
     same applies to the line and the table rows of a transition. */
  const drawn = new Set(all(".main svg a[data-m]").map((link) => link.dataset.m));
  let joint = [];
  function join(node) {
    joint.forEach((part) => part.classList.remove("joint"));
    joint = partners(node);
    joint.forEach((part) => part.classList.add("joint"));
  }
  function partners(node) {
    const pin = node.closest("[data-pin]"),
      part = node.closest("button[data-part]");
    if (pin || part) {
      const pins = pin ? [pin] : all(`[data-pin][data-part="${part.dataset.part}"]`);
      const names = new Set(pins.map((own) => own.dataset.pin));
      return [...pins, ...all(".prose tbody tr").filter((row) => names.has(row.cells[0].textContent.trim()))];
    }
    const listed = node.closest(".prose tbody tr");
    if (listed && one("[data-pin]"))
      return all("[data-pin]").filter((own) => own.dataset.pin === listed.cells[0].textContent.trim());
    const edge = node.closest(".edge"),
      row = node.closest("tr[data-edge]");
    const step = (edge && one("path", edge).id) || (row && row.dataset.edge);
    if (step) {
      const line = document.getElementById(step);
      return [...all(`tr[data-edge="${step}"]`), ...(line ? [line.parentNode] : [])];
    }
    const place = node.closest(".where li, .stack tbody tr");
    const name = node.closest("[data-m]") || (place && one("a.mod[data-m]", place));
    if (!name || !drawn.has(name.dataset.m)) return [];
    return all(`.main [data-m="${name.dataset.m}"]`).map((link) =>
      link.closest("svg") ? link : link.closest("tr:not([data-edge]), .where li") || link,
    );
  }

  /* shows the card of a module on hover, on focus, and on the first tap */
  let card = null,
    owner = null,
    timer = 0,
    touched = false,
    silent = false;
  function hide() {
    clearTimeout(timer);
    const back = card && card.contains(document.activeElement) ? owner : null; // the link gets the focus that the card had
    if (card) card.remove();
    if (owner) owner.removeAttribute("aria-details");
    card = owner = null;
    return back;
  }
  function show(link) {
    if (owner === link) return;
    hide();
    const name = link.dataset.m,
      module = data.modules[name];
    if (!module || module.kind === "d") return;
    owner = link;
    card = document.createElement("div");
    card.className = "card";
    card.id = "card";
    card.dataset.m = name;
    card.setAttribute("role", "group");
    card.setAttribute("aria-label", "Views of " + name);
    const roles = module.roles
      .map((role) => escape(role[0]) + " in " + escape(role[1]))
      .join("<br>");
    card.innerHTML =
      `<div class="hd"><span class="nm ${module.kind}">${name}</span><span>${module.kind === "a" ? "abstract" : "concrete"}, in <span class="logic">${escape(module.logic)}</span></span></div>` +
      `<dl><dt>secret</dt><dd>${escape(module.secret)}</dd>${roles ? `<dt>roles</dt><dd>${roles}</dd>` : ""}</dl>` +
      `<div class="words">${VIEWS.filter((v) => module.views.includes(v[0]))
        .map(
          (v) =>
            `<a tabindex="-1" href="${viewOf(name, v[2])}"><span class="key" aria-hidden="true">${v[0]}</span>${v[1]}</a>`,
        )
        .join("")}</div>`;
    link.setAttribute("aria-details", "card");
    /* The card is not a child of the link, because the styles of the link do not fit a card. If the link is in a
       dialog, the card is a child of this dialog, because the dialog would cover any card outside it. */
    (link.closest("dialog") || document.body).append(card);
    const at = link.closest("svg") ? link.getBoundingClientRect() : link.getClientRects()[0],
      height = card.offsetHeight;
    const below = at.bottom + height + 12 < innerHeight || at.top < height + 12;
    card.style.left = Math.max(12, Math.min(at.left, innerWidth - card.offsetWidth - 12)) + "px";
    card.style.top = (below ? at.bottom + 5 : at.top - height - 5) + "px";
  }
  const within = (node) => (card && card.contains(node)) || (owner && owner.contains(node));
  const named = (node) => node.closest && node.closest("a.mod[data-m], svg a[data-m]");
  document.addEventListener("pointerover", (event) => {
    join(event.target);
    if (event.pointerType === "touch") return;
    const link = named(event.target);
    clearTimeout(timer);
    if (link) timer = setTimeout(() => show(link), card ? 60 : 240);
    else if (card && !within(event.target)) timer = setTimeout(hide, 240);
  });
  document.addEventListener("focusin", (event) => {
    const link = named(event.target);
    join(event.target);
    if (link && link.matches(":focus-visible") && !silent) show(link);
    else if (!within(event.target)) hide();
  });
  document.addEventListener("pointerdown", (event) => {
    touched = event.pointerType === "touch";
    if (card && !within(event.target)) hide();
  });
  document.addEventListener("click", (event) => {
    const link = named(event.target);
    if (touched && link && owner !== link) {
      event.preventDefault();
      show(link);
    }
  });
  addEventListener(
    "scroll",
    () => {
      if (card && !card.matches(":hover") && !card.contains(document.activeElement)) hide();
    },
    { passive: true },
  );

  /* search: shows the hits that search.js returns, in groups, and a preview of the chosen hit */
  const input = one("#q"),
    hits = one("#hits"),
    field = input.parentElement;
  const GROUP_SIZE = 5; // number of hits of a group that are shown at first
  const SCRIPTS = ["minisearch", "search_index", "search"];
  let chosen = -1,
    shown = [],
    loading = null;
  /* loads the scripts of the search when the reader first uses the search */
  function load() {
    const read = (name) =>
      new Promise((done) => {
        const script = document.createElement("script");
        script.async = false;
        script.src = `${base}_static/${name}.js`;
        script.addEventListener("load", done);
        document.head.append(script);
      });
    loading = loading || Promise.all(SCRIPTS.map(read));
    return loading;
  }
  /* Returns a text as HTML, in which the found words are marked. The mark includes an ending (such as -ing) that the
     search ignores. */
  function lit(text, words) {
    const sorted = [...words].sort((a, b) => b.length - a.length);
    if (!sorted.length) return escape(text);
    return text
      .split(new RegExp(`((?:${sorted.join("|")})(?:at)?(?:ion|e[ds]?|ing|s)?)`, "giu"))
      .map((part, i) => (i % 2 ? `<mark>${escape(part)}</mark>` : escape(part)))
      .join("");
  }
  /* Returns the part of a text around the first found word. */
  function around(text = "", words, length = 80) {
    const small = text.toLowerCase();
    const i = Math.min(...words.map((word) => small.indexOf(word)).filter((at) => at >= 0));
    if (!Number.isFinite(i)) return "";
    return `… ${text.slice(text.lastIndexOf(" ", Math.max(0, i - 20)) + 1, i + length)} …`;
  }
  function row(hit, number, heading) {
    const [group, key, title, words, address, more] = PORTAL_SEARCH.entries[hit.id];
    const letter = /^[A-Z]$/.test(key)
      ? `<span class="key" aria-hidden="true">${key}</span>`
      : "<span></span>";
    const kind = group === heading ? "" : `${group}: `;
    const text = kind + lit(`${words} ${group === "Answers" ? "" : around(more, hit.terms)}`, hit.terms);
    return `<a role="option" tabindex="-1" id="hit${number}" class="${key}" href="${base + address}">${letter}<b>${lit(title, hit.terms)}</b><span class="d">${text}</span></a>`;
  }
  /* Returns the preview of a hit as HTML: its group, its text, the text around the first found word, and its address.
     */
  function preview(hit) {
    if (hit.group) return "";
    const [group, , title, words, address, more] = PORTAL_SEARCH.entries[hit.id];
    const module = data.modules[title];
    const roles = module ? module.roles.map((role) => `${role[0]} in ${role[1]}`) : [];
    const found = group === "Answers" ? "" : around(more, hit.terms, 400);
    const texts = [words, found, ...roles].filter(Boolean);
    return `<p class="tag">${group}</p><p class="t">${escape(title)}</p>${texts.map((text) => `<p>${lit(text, hit.terms)}</p>`).join("")}<p class="tag">${escape(address)}</p>`;
  }
  async function find(text, whole = "") {
    if (!text.trim()) return close();
    await load();
    if (text !== input.value) return; // the reader typed more while the scripts were loaded
    let list = "";
    shown = [];
    for (const [group, found] of PortalSearch.grouped(text)) {
      const size = group === whole ? found.length : GROUP_SIZE;
      list += `<div role="group" aria-label="${group}"><div class="g" role="presentation"><span>${group}</span><span>${found.length}</span></div>`;
      for (const hit of found.slice(0, size)) list += row(hit, shown.push(hit) - 1, group);
      if (found.length > size) {
        const number = shown.push({ group }) - 1;
        list += `<a role="option" tabindex="-1" id="hit${number}" class="more"><span></span><b>All ${found.length} in ${group}</b></a>`;
      }
      list += "</div>";
    }
    const none =
      '<div class="g">No entry contains these words. Try fewer words, or a name such as MainController or FR-15.</div>';
    one(".list", hits).innerHTML = list || none;
    hits.hidden = false;
    input.setAttribute("aria-expanded", "true");
    choose(shown.length ? 0 : -1);
  }
  function close() {
    hits.hidden = true;
    input.setAttribute("aria-expanded", "false");
    input.removeAttribute("aria-activedescendant");
    chosen = -1;
  }
  function choose(number) {
    chosen = number;
    one(".preview", hits).innerHTML = number < 0 ? "" : preview(shown[number]);
    all("a", hits).forEach((hit, i) => {
      hit.setAttribute("aria-selected", i === number);
      if (i === number) {
        input.setAttribute("aria-activedescendant", hit.id);
        hit.scrollIntoView({ block: "nearest" });
      }
    });
  }
  input.addEventListener("focus", load);
  input.addEventListener("input", () => find(input.value));
  input.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown" && hits.hidden) find(input.value);
    else if (/^Arrow(Up|Down)$/.test(event.key) && shown.length) {
      choose((chosen + (event.key === "ArrowDown" ? 1 : shown.length - 1)) % shown.length);
      event.preventDefault();
    } else if (event.key === "Enter" && chosen >= 0) all("a", hits)[chosen].click();
    else if (event.key === "Escape") {
      close(); // the input keeps the focus
      event.preventDefault();
    }
  });
  field.addEventListener("focusout", (event) => {
    if (!field.contains(event.relatedTarget)) close();
  });
  hits.addEventListener("pointerdown", (event) => {
    if (event.target.closest(".list")) event.preventDefault(); // the input keeps the focus
  });
  hits.addEventListener("pointerover", (event) => {
    const at = all("a", hits).indexOf(event.target.closest("a"));
    if (at >= 0 && at !== chosen) choose(at);
  });
  hits.addEventListener("click", (event) => {
    const at = all("a", hits).indexOf(event.target.closest("a"));
    if (at >= 0 && shown[at].group) find(input.value, shown[at].group);
  });
  all("[data-try]").forEach((word) =>
    word.addEventListener("click", () => {
      input.value = word.dataset.try;
      input.focus();
      find(input.value);
    }),
  );
  const asked = new URLSearchParams(location.search).get("q");
  if (asked) {
    input.value = asked;
    find(asked);
  }

  /* filters of lists */
  all("[data-filter]").forEach((field) => {
    const rows = all(field.dataset.filter),
      count = one(".count", field.parentElement);
    const facets = all("[data-facet]", field.parentElement);
    const narrow = () => {
      const word = field.value.trim().toLowerCase();
      const chosen = facets.filter((facet) => facet.value);
      rows.forEach((row) => {
        const fits = (facet) => row.dataset[facet.dataset.facet].split("|").includes(facet.value);
        row.hidden = !row.textContent.toLowerCase().includes(word) || !chosen.every(fits);
      });
      const narrowed = word !== "" || chosen.length > 0;
      all(".tree details")
        .reverse()
        .forEach((part) => {
          part.hidden = narrowed && !all(".leaf", part).some((leaf) => !leaf.hidden);
        });
      all(".main > .sec").forEach((part) => {
        const own = rows.filter((row) => part.contains(row));
        part.hidden = own.length > 0 && own.every((row) => row.hidden);
      });
      all(".mx tbody").forEach((part) => {
        part.hidden = all("tr.row", part).every((row) => row.hidden);
      });
      const left = rows.filter((row) => !row.hidden).length;
      count.textContent =
        (left === rows.length ? "" : left + " of ") + rows.length + " " + count.dataset.noun;
    };
    /* the address of the page contains the chosen filters, so that a copied link shows the same list */
    const controls = [field, ...facets];
    const nameOf = (control) => control.dataset.facet || "filter";
    const keepInAddress = () => {
      const address = new URL(location.href);
      controls.forEach((control) => {
        if (control.value) address.searchParams.set(nameOf(control), control.value);
        else address.searchParams.delete(nameOf(control));
      });
      history.replaceState(history.state, "", address);
    };
    const wanted = new URL(location.href).searchParams;
    controls.forEach((control) => {
      const value = wanted.get(nameOf(control));
      if (value !== null) control.value = value;
      control.addEventListener("input", () => {
        narrow();
        keepInAddress();
      });
    });
    if (controls.some((control) => control.value)) narrow();
  });
  all("[data-open]").forEach((control) =>
    control.addEventListener("click", () =>
      all(".tree details").forEach((part) => {
        part.open = control.dataset.open === "true";
      }),
    ),
  );

  /* a column that contains mostly numbers is aligned to the right, and so is its heading */
  const NUMBER = /^[-+−]?\d[\d.\s]*(?:%|[mµn]?s|[kM]?B|bytes|m?V|m?A|rpm|m|°|cycles)?$/;
  const MOSTLY = 0.8; // least share of a column's cells that are numbers
  all(".main table:not(.umx, .dot)").forEach((table) => {
    const heads = [...(table.tHead ? table.tHead.rows[0].cells : [])];
    const rows = all("tbody tr", table).filter((row) => row.cells.length === heads.length);
    heads.forEach((head, i) => {
      const cells = rows.map((row) => row.cells[i]);
      const filled = cells.filter((cell) => cell.textContent.trim());
      const numbers = filled.filter((cell) => NUMBER.test(cell.textContent.trim()));
      if (numbers.length < 2 || numbers.length < MOSTLY * filled.length) return;
      [head, ...cells].forEach((cell) => cell.classList.add("num"));
    });
  });

  /* scrolls the side navigation, so that the entry of the current page is visible */
  const here = one(".side [aria-current]");
  if (here) side.scrollTop = here.offsetTop - side.clientHeight / 3;

  /* adds a link to each section, a table of contents to a long page, and a copy button to code */
  const heads = all(".main .sec[id] > h2, .prose section[id] > h2, .prose section[id] > h3");
  heads.forEach((head) => {
    if (one(".headerlink", head)) return;
    const link = document.createElement("a");
    link.className = "headerlink";
    link.href = "#" + head.parentElement.id;
    link.textContent = "#";
    link.setAttribute("aria-label", "Link to this section");
    head.insertBefore(link, one(".more", head));
  });
  const titleOf = (head) =>
    [...head.childNodes]
      .filter((node) => !(node.classList && node.matches(".headerlink, .more, .key")))
      .map((node) => node.textContent)
      .join("")
      .trim();
  const CONTENTS = 3; // least number of sections of a page that gets a table of contents
  if (heads.length >= CONTENTS && !one(".home, .vkbar, .rail")) {
    const list = document.createElement("nav");
    list.className = "contents";
    list.setAttribute("aria-label", "On this page");
    list.innerHTML = `<details><summary>On this page</summary>${heads
      .map((head) => {
        const sub = head.tagName === "H3" ? ' class="sub"' : "";
        return `<a${sub} href="#${head.parentElement.id}">${escape(titleOf(head))}</a>`;
      })
      .join("")}</details>`;
    one(".shell").append(list);
    const beside = !one(".main.wide, .pa, .embed"); // next to these elements, there is no space for the table of contents
    one(".shell").classList.toggle("beside", beside);
    one("details", list).open = beside && matchMedia("(min-width: 1241px)").matches;
  }
  all(".prose .highlight, .code").forEach((block) => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "btn copy";
    button.textContent = "Copy";
    button.addEventListener("click", async () => {
      const lines = all(".cl", block);
      const text = lines.length
        ? lines.map((line) => line.textContent.replace(/^\s*\d+/, "")).join("\n")
        : one("pre", block).textContent;
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
    });
    block.parentElement.style.position = "relative";
    block.parentElement.append(button);
  });

  /* the Tab key reaches the elements that scroll sideways, so that the arrow keys can scroll them */
  const reachable = () =>
    all(".prose .highlight, .prose table").forEach((part) => {
      if (part.scrollWidth > part.clientWidth) part.tabIndex = 0;
    });
  reachable();
  addEventListener("resize", reachable);

  /* scrolls a wide diagram, so that its marked element is in the middle */
  all(".scroll:has(> .located)").forEach((frame) => {
    const marked = one(".lit", frame).getBoundingClientRect(),
      view = frame.getBoundingClientRect();
    frame.scrollLeft += (marked.left + marked.right - view.left - view.right) / 2;
  });

  /* shows the present step of the active tour in a bar at the bottom of the window */
  const tours = data.tours || {};
  function read() {
    try {
      return JSON.parse(localStorage.getItem("tour"));
    } catch (error) {
      return null; // without storage there is no tour
    }
  }
  function keep(state) {
    try {
      if (state) localStorage.setItem("tour", JSON.stringify(state));
      else localStorage.removeItem("tour");
    } catch (error) {
      /* Without storage, the tour ends when the reader leaves this page. */
    }
  }
  all("[data-tour]").forEach((link) =>
    link.addEventListener("click", () =>
      keep({ id: link.dataset.tour, at: Number(link.dataset.stop || 0) }),
    ),
  );
  function showTour() {
    const state = read(),
      tour = state && tours[state.id],
      stops = tour ? tour.stops : [];
    const old = one(".touring");
    if (old) old.remove();
    if (!stops[state && state.at]) return;
    const last = state.at === stops.length - 1;
    const bar = document.createElement("nav");
    bar.className = "touring";
    bar.setAttribute("aria-label", "Tour: " + tour.title);
    const go = (at, words) =>
      stops[at]
        ? `<a class="btn" data-at="${at}" href="${base + stops[at].address}">${words}</a>`
        : "";
    const end = last
      ? `<a class="btn" data-end href="${base}tours/${state.id}.html#action">Your task</a>`
      : "";
    bar.innerHTML = `<b>${state.at + 1} of ${stops.length}</b><span>${escape(stops[state.at].look)}</span>${go(state.at - 1, "Back")}${go(state.at + 1, "Next")}${end}<button class="btn" type="button">End the tour</button>`;
    bar.addEventListener("click", (event) => {
      const link = event.target.closest("a, button");
      if (!link) return;
      keep(link.dataset.at ? { id: state.id, at: Number(link.dataset.at) } : null);
      if (!link.href) bar.remove();
      else setTimeout(showTour); // the next step of the tour may be on this page
    });
    document.body.append(bar);
  }
  showTour();

  /* an address with a hash opens the folded elements around its target */
  function reveal() {
    const target =
      location.hash && document.getElementById(decodeURIComponent(location.hash.slice(1)));
    for (let part = target; part; part = part.parentElement)
      if (part.tagName === "DETAILS") part.open = true;
    if (target) target.scrollIntoView();
  }
  addEventListener("hashchange", reveal);
  if (location.hash) reveal();

  /* marks the link to the visible section, in the bar of a module page and in the table of contents */
  const links = new Map(
    all('.vkbar a[href^="#"], .contents a').map((link) => [link.hash.slice(1), link]),
  );
  if (links.size) {
    const watcher = new IntersectionObserver(
      (entries) =>
        entries.forEach((entry) => {
          if (!entry.isIntersecting) return;
          links.forEach((link) => link.removeAttribute("aria-current"));
          links.get(entry.target.id).setAttribute("aria-current", "true");
        }),
      { rootMargin: "-110px 0px -70% 0px" },
    );
    links.forEach((_, id) => {
      const section = document.getElementById(id);
      if (section && !section.closest(".rail")) watcher.observe(section); // the rail is always
                                                                          // visible
    });
  }
})();
