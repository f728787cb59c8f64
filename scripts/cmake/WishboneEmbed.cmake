# wishbone_embed(TARGET NAMESPACE name=file ...): makes the bytes of each file available to TARGET as
#   namespace NAMESPACE { extern const std::string_view name; }
# so that an installed program needs no data files. The declarations are the user's (one header, written by hand).
# Run as a script (-P) this file writes one such source.
if(CMAKE_SCRIPT_MODE_FILE)
  file(READ ${INPUT} bytes HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(REGEX REPLACE "(....................................................................................................)" "\\1\n" bytes "${bytes}")
  file(WRITE ${OUTPUT} "#include <string_view>

namespace {
const unsigned char kBytes[] = {
${bytes}};
}

namespace ${NAMESPACE} {
extern const std::string_view ${NAME};
const std::string_view ${NAME}(reinterpret_cast<const char*>(kBytes), sizeof kBytes);
}
")
  return()
endif()

set(WISHBONE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
function(wishbone_embed target namespace)
  foreach(pair IN LISTS ARGN)
    string(REGEX MATCH "^([^=]+)=(.+)$" unused "${pair}")
    set(name ${CMAKE_MATCH_1})
    get_filename_component(input ${CMAKE_MATCH_2} ABSOLUTE)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/embedded/${name}.cpp)
    add_custom_command(OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DINPUT=${input} -DOUTPUT=${output} -DNAMESPACE=${namespace} -DNAME=${name}
              -P ${WISHBONE_EMBED_SCRIPT}
      DEPENDS ${input} ${WISHBONE_EMBED_SCRIPT} VERBATIM)
    target_sources(${target} PRIVATE ${output})
  endforeach()
endfunction()
