#pragma once

// Always inlined: passing small vectors between functions through memory stores them one by one and reads them
// together, which stalls the processor.
#define VSPRING_INLINE __attribute__((always_inline)) inline
