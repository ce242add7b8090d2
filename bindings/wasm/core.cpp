// The functions of the library for pages; its classes are in files of their own.

#include <emscripten/bind.h>

#include "vspring/vspring.hpp"

EMSCRIPTEN_BINDINGS(vspring) {
  emscripten::function(
      "version", +[]() -> std::string { return vspring::version(); });
}
