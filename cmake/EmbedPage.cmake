# Makes one C++ source of the files of page/: cmake -DPAGE=page -DOUTPUT=page_template.cpp -P EmbedPage.cmake
# Modules are put into one script, main.js last, since a page that opens from a file cannot import others.
file(GLOB scripts ${PAGE}/*.js)
list(REMOVE_ITEM scripts ${PAGE}/main.js)
set(script "")
foreach(path IN LISTS scripts ITEMS ${PAGE}/main.js)
  file(READ ${path} text)
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND script "${text}")
endforeach()
file(READ ${PAGE}/page.css style)
file(READ ${PAGE}/page.html page)
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
file(WRITE ${OUTPUT}
  "#include \"page_template.hpp\"\n\nnamespace vspring::cli {\n\nconst char* const page_template =${literals};\n\n}  // namespace vspring::cli\n")
