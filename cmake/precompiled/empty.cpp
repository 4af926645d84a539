// The targets of precompiled headers need a source file.
