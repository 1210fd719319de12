"""One file a task: a constant TASK of type tasks.base.Task, named as the file with dashes."""
