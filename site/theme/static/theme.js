/* Sets the light or dark theme that the reader chose earlier. This happens before the browser shows the page. */
(function () {
  var chosen = new URLSearchParams(location.search).get("theme");
  try { chosen = chosen || localStorage.getItem("theme"); } catch (error) { /* without storage, the setting of the operating system applies */ }
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
})();
