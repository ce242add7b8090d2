#pragma once

/// A shared library exports all that is declared in the body of such a namespace; all else is hidden.
#define VSPRING_API [[gnu::visibility("default")]]
