/* Shows the tasks that ./wr portal is running. Loads the page again when ./wr portal has written the pages with new
 * results. */
(function () {
  "use strict";
  if (!location.protocol.startsWith("http")) return;
  const address = (document.documentElement.dataset.root || "") + "status.json";
  const line = document.createElement("div");
  line.className = "status";
  line.setAttribute("role", "status");
  let pages = null; // version of the pages when this page was loaded
  const clock = (seconds) =>
    Math.floor(seconds / 60) + ":" + String(Math.floor(seconds % 60)).padStart(2, "0");

  function running(task) {
    const since = clock(Math.max(0, Date.now() / 1000 - task.since));
    return task.name + " " + since + (task.seconds ? " of about " + clock(task.seconds) : "");
  }

  function show(state) {
    const waiting = state.waiting.length ? "; " + state.waiting.length + " more waiting" : "";
    const failed = state.failed.length ? " Failed: " + state.failed.join(", ") + "." : "";
    line.textContent = state.over
      ? failed && "The results are complete." + failed
      : "Running: " + (state.running.map(running).join(", ") || "pages") + waiting +
        ". Until the tasks end, results on this page may be missing or out of date." + failed;
    if (line.textContent && !line.isConnected) document.body.append(line);
    if (!line.textContent) line.remove();
  }

  async function poll() {
    let state;
    try {
      const answer = await fetch(address, { cache: "no-store" });
      if (!answer.ok) return; // no task is running
      state = await answer.json();
    } catch (error) {
      return line.remove(); // the server has ended
    }
    if (pages !== null && state.pages !== pages) return location.reload();
    pages = state.pages;
    show(state);
    if (!state.over) setTimeout(poll, 1000);
  }
  poll();
})();
