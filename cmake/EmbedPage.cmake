# Makes one C++ source of the files of page/: cmake -DPAGE=page -DOUTPUT=page_template.cpp -P EmbedPage.cmake
# Modules are put into one script, main.js last, since a page that opens from a file cannot import others.
file(GLOB shared ${PAGE}/*.js)
list(REMOVE_ITEM shared ${PAGE}/main.js)
file(READ ${PAGE}/page.css style)

# The markup with the modules in it, as the definition of a constant.
function(embed name markup)
  set(script "")
  foreach(path IN LISTS ARGN)
    file(READ ${path} text)
    string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
    string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
    string(APPEND script "${text}")
  endforeach()
  file(READ ${markup} page)
  string(REPLACE "@STYLE@" "${style}" page "${page}")
  string(REPLACE "@SCRIPT@" "${script}" page "${page}")
  # Literals have a length that every compiler takes.
  set(literals "")
  string(LENGTH "${page}" length)
  set(begin 0)
  while(begin LESS length)
    string(SUBSTRING "${page}" ${begin} 8000 piece)
    string(APPEND literals "\n    R\"page(${piece})page\"")
    math(EXPR begin "${begin} + 8000")
  endwhile()
  file(APPEND ${OUTPUT} "\nconst char* const ${name} =${literals};\n")
endfunction()

file(WRITE ${OUTPUT} "#include \"page_template.hpp\"\n\nnamespace vspring::cli {\n")
embed(page_template ${PAGE}/page.html ${shared} ${PAGE}/main.js)
embed(picture_template ${PAGE}/picture/picture.html ${shared} ${PAGE}/picture/panels.js ${PAGE}/picture/main.js)
file(APPEND ${OUTPUT} "\n}  // namespace vspring::cli\n")
