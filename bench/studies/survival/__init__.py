"""Commands that are killed in each of their phases and given again; runs, at every one of their file operations too."""
