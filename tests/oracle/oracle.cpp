// Placeholder translation unit of the oracle.
