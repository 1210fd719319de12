/* A formula or picture that is wider than its box is reached by the tab key, so that the arrow keys scroll it. */
(function () {
  "use strict";
  const boxes = document.querySelectorAll("div.math, .card-formula, .card-costs, .picture");
  const seen = new ResizeObserver(entries => entries.forEach(({ target }) => {
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }));
  boxes.forEach(box => seen.observe(box));
})();
