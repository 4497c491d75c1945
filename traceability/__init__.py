"""The tools of the project: the model, its checks, its documents, and the commands of ./wr."""
