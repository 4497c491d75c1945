"""Documents: the pages, diagrams and search index of the portal, generated from the model."""
