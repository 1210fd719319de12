"""How all figures look, what a page shows beside drawings, and how it pastes its module: kit.page("chapter.page")."""

from report.figures.kit.page import page

__all__ = ["page"]
