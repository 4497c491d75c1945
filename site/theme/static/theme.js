/* Sets the theme that the reader chose, before the page is shown. */
(function () {
  var chosen = new URLSearchParams(location.search).get("theme");
  try { chosen = chosen || localStorage.getItem("theme"); } catch (error) { /* no storage: the system decides */ }
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
})();
