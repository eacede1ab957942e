// Nothing of its own: the headers are read for it.
