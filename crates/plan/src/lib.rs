//! Structure, edit and mode in, Plan out: names, caches, lowers rules to systems, explains.
