/* Before the first paint: the theme that the reader chose. */
(function () {
  var chosen = new URLSearchParams(location.search).get("theme");
  try { chosen = chosen || localStorage.getItem("theme"); } catch (error) { /* no storage: the system decides */ }
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
})();
