#pragma once

/// What stands in this body of a namespace, and what it declares, a shared library exports; all else is built hidden.
#define VSPRING_API [[gnu::visibility("default")]]
