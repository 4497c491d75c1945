/* Checks whether the browser can run the robot in a page, and shows the reason if it cannot. */
(function (scope) {
  "use strict";

  /* Returns the reason why the browser cannot run the robot, or an empty text. */
  function reason() {
    if (location.protocol === "file:")
      return "a page that was opened as a file cannot load the virtual board; serve the pages with ./wr serve";
    if (typeof WebAssembly === "undefined" || typeof Worker === "undefined")
      return "this browser does not support WebAssembly or web workers";
    return "";
  }

  /* Shows the part of the page that runs the robot. If the browser cannot run the robot, this part shows the reason,
     and its button is disabled. Returns whether the browser can run the robot. */
  function shows(place) {
    place.hidden = false;
    if (!reason()) return true;
    place.querySelector("[data-go]").disabled = true;
    place.querySelector("[data-result], [data-detail]").textContent = `The robot cannot run here: ${reason()}.`;
    return false;
  }

  scope.LiveCheck = { reason, shows };
  if (typeof module !== "undefined") module.exports = scope.LiveCheck;
})(globalThis);
