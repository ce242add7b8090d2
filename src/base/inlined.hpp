#pragma once

// Into each of its callers, whatever the compiler thinks of its size: lest vectors of a few numbers be handed from one
// function to another through memory, stored one by one and read again together, for which a processor waits.
#define VSPRING_INLINE __attribute__((always_inline)) inline
