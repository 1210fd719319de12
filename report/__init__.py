"""The book: its pages, its figures, and how it is built."""
