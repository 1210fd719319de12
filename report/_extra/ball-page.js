/* The page of a ball in a chapter: it is as light or dark as the chapter, and tells it how high it is (ball-frame.js). */
(function () {
  "use strict";
  const root = document.documentElement, isDark = matchMedia("(prefers-color-scheme: dark)");

  function follow(theme) {
    root.dataset.theme = theme || (isDark.matches ? "dark" : "light");
  }
  function tell() {
    parent.postMessage({ ballHeight: Math.ceil(document.body.getBoundingClientRect().height) }, "*");
  }
  addEventListener("message", ({ data, source }) => {
    if (source !== parent || !data || !["light", "dark"].includes(data.theme)) return;
    follow(data.theme);
  });
  isDark.addEventListener("change", () => { if (parent === window) follow(); });
  follow();
  document.addEventListener("DOMContentLoaded", () => {
    if (parent !== window) new ResizeObserver(tell).observe(document.body);
  });
})();
