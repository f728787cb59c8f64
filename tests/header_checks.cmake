# Every header compiles on its own: one source per header, built on demand (scripts/lint).
add_library(header_checks OBJECT EXCLUDE_FROM_ALL)
foreach(room IN ITEMS core bodies joints forces identification solver models app)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/${room}/*.h)
  foreach(header IN LISTS headers)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/header_checks/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
    target_sources(header_checks PRIVATE ${source})
  endforeach()
endforeach()
set_target_properties(header_checks PROPERTIES CXX_EXTENSIONS OFF)
target_link_libraries(header_checks PRIVATE
  wishbone_app wishbone_warnings SUNDIALS::cvode SUNDIALS::ida SUNDIALS::arkode)
