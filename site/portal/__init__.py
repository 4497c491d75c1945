"""Documents: the pages, diagrams and search index of the portal, made from the model."""
