"""The ground: a smooth surface through the nodes, and the ledger of what may be eroded."""
