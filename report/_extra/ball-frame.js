/* The balls in a chapter: each frame is as high as its page says, and as light or dark as the chapter. */
(function () {
  "use strict";
  const BORDERS = 2, root = document.documentElement, frames = [...document.querySelectorAll(".ball-view iframe")];

  const tell = frame => frame.contentWindow.postMessage({ theme: root.dataset.theme }, "*");
  addEventListener("message", ({ data, source }) => {
    const frame = frames.find(one => one.contentWindow === source);
    if (!frame || !data || !Number.isFinite(data.ballHeight)) return;
    frame.style.height = `${data.ballHeight + BORDERS}px`;
    tell(frame);
  });
  new MutationObserver(() => frames.forEach(tell)).observe(root, { attributeFilter: ["data-theme"] });
})();
