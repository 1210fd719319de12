"""One translator for all that is written in the law dialect: types are inferred, and text is written."""
