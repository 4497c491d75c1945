/* Adds a button to each diagram that is wider than its frame in the page. The button opens a window with the diagram,
 * where the reader can enlarge it. On a phone the diagram is shrunk to the width of its frame. Without this script
 * there is no button, and the reader scrolls a wide diagram in its frame. */
(function () {
  "use strict";
  const STEP = 1.25; // factor of the zoom buttons and keys
  const READABLE = 0.93; // a diagram that is shrunk to this share of its size is still readable
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

  /* Opens the window and moves the diagram into it. When the window is closed, the diagram moves back. A copy of the
   * diagram would lose its live marks and would repeat its ids. */
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
      event.stopPropagation(); // otherwise the letter keys of the page would also react
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

  /* The frame of a diagram gets its width when it is shown, and a different width when a phone is turned. The script
   * adds the button in the next animation frame, because browsers report an error if the page is changed while the
   * ResizeObserver delivers new sizes. */
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
