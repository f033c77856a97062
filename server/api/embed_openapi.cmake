# Makes `openapi_text()` of the API description: cmake -DTEXT=openapi.json -DOUT=openapi.cpp -P embed_openapi.cmake
file(READ ${TEXT} text)
# String literals have a length limit, so it is cut into pieces that the compiler joins.
string(LENGTH "${text}" length)
set(pieces "")
set(at 0)
while(at LESS length)
  string(SUBSTRING "${text}" ${at} 8000 piece)
  string(APPEND pieces "R\"~~(${piece})~~\"\n")
  math(EXPR at "${at} + 8000")
endwhile()
file(WRITE ${OUT} "#include \"server/api/api.hpp\"\nnamespace dripline::api {\nstd::string_view openapi_text() {\n  return ${pieces};\n}\n}\n")
