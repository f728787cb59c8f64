// Nothing: a target that precompiles headers for others must have a source.
