// What a page sees of the library beside its classes, which are in files of their own.

#include <emscripten/bind.h>

#include "vspring/vspring.hpp"

EMSCRIPTEN_BINDINGS(vspring) {
  emscripten::function(
      "version", +[]() -> std::string { return vspring::version(); });
}
