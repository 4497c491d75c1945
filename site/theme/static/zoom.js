/* Adds a button to each diagram that is wider than the text column. The button opens a window that shows the whole
 * diagram, and the reader can enlarge it there. On a phone the page shrinks the diagram to the width of the text
 * column. If this script does not run, the reader scrolls the diagram sideways. */
(function () {
  "use strict";
  const STEP = 1.25; // factor of the zoom buttons and keys
  const READABLE = 0.93; // share of the size at which a diagram is still readable without the window
  const LEAST = 0.25;
  const MOST = 4;

  const natural = (svg) => svg.viewBox.baseVal.width || svg.getBoundingClientRect().width;

  function addButton(place, svg) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "btn enlarge";
    button.textContent = "Enlarge";
    button.setAttribute("aria-label", `Enlarge: ${place.getAttribute("aria-label") || "diagram"}`);
    button.addEventListener("click", () => open(place, svg));
    place.after(button);
  }

  /* The diagram moves into the window and back, so that its links, ids and live marks stay. */
  function open(place, svg) {
    const dialog = document.createElement("dialog");
    dialog.className = "zoom";
    dialog.setAttribute("aria-label", place.getAttribute("aria-label") || "Diagram");
    const bar = document.createElement("div");
    bar.className = "zoombar";
    const sheet = document.createElement("div");
    sheet.className = "sheet";
    sheet.tabIndex = 0;
    sheet.setAttribute("role", "region");
    sheet.setAttribute("aria-label", "Diagram");
    const style = svg.getAttribute("style");
    let scale = 1;
    function set(wanted) {
      const middle = [sheet.scrollLeft + sheet.clientWidth / 2, sheet.scrollTop + sheet.clientHeight / 2];
      const next = Math.min(MOST, Math.max(LEAST, wanted));
      svg.style.width = `${natural(svg) * next}px`;
      sheet.scrollLeft = (middle[0] * next) / scale - sheet.clientWidth / 2;
      sheet.scrollTop = (middle[1] * next) / scale - sheet.clientHeight / 2;
      scale = next;
    }
    const fit = () => sheet.clientWidth / natural(svg);
    const actions = [
      ["Smaller", "-", () => set(scale / STEP)],
      ["Larger", "+", () => set(scale * STEP)],
      ["Whole", "0", () => set(fit())],
      ["Close", "", () => dialog.close()],
    ];
    for (const [name, key, act] of actions) {
      const button = document.createElement("button");
      button.type = "button";
      button.className = "btn";
      button.textContent = name;
      if (key) button.setAttribute("aria-keyshortcuts", key);
      button.addEventListener("click", act);
      bar.append(button);
    }
    dialog.addEventListener("keydown", (event) => {
      const found = actions.find(([, key]) => key && key === event.key);
      event.stopPropagation(); // the letter keys of the page do not act
      if (found) found[2]();
    });
    dialog.addEventListener("close", () => {
      if (style === null) svg.removeAttribute("style");
      else svg.setAttribute("style", style);
      place.append(svg);
      dialog.remove();
      place.nextElementSibling.focus();
    });
    sheet.append(svg);
    dialog.append(bar, sheet);
    document.body.append(dialog);
    dialog.showModal();
    set(Math.max(1, fit()));
    sheet.focus();
  }

  /* A place has a width when it is shown, and another width when a phone is turned. The page is changed in the next
   * frame, because a change while sizes are observed is an error of the browser. */
  const diagrams = new Map();
  function offer(place) {
    const svg = diagrams.get(place);
    const scrolls = place.scrollWidth > place.clientWidth + 1;
    const wide = place.clientWidth && (scrolls || natural(svg) * READABLE > place.clientWidth);
    if (wide && !place.classList.contains("wide")) {
      place.classList.add("wide");
      addButton(place, svg);
    }
  }
  const watch = new ResizeObserver((changes) => {
    requestAnimationFrame(() => changes.forEach(({ target }) => offer(target)));
  });
  for (const place of document.querySelectorAll(".scroll:has(> svg)")) {
    diagrams.set(place, place.querySelector(":scope > svg"));
    watch.observe(place);
  }
})();
