# dripline_embed_schema(OUTPUT SQL_FILE...): writes a source file that holds the migrations, in the order given, as text.
function(dripline_embed_schema OUTPUT)
  set(rows "")
  set(version 0)
  foreach(file ${ARGN})
    math(EXPR version "${version} + 1")
    get_filename_component(name ${file} NAME_WE)
    file(READ ${CMAKE_CURRENT_SOURCE_DIR}/${file} sql)
    string(APPEND rows "    {${version}, \"${name}\", R\"schema(${sql})schema\", step_after(${version})},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
// Generated from storage/schema/*.sql.
#include "storage/impl/audit_repository.hpp"
#include "storage/impl/sqlite_connections.hpp"

namespace dripline::storage {
namespace {

Result<void> begin_chain_of(sqlite::Database& database) {
  return begin_chain(database);
}

constexpr auto step_after(int version) {
  return version == 9 ? &begin_chain_of : nullptr;
}

constexpr sqlite::Migration kMigrations[] = {
@rows@};

}  // namespace

std::span<const sqlite::Migration> schema() {
  return kMigrations;
}

}  // namespace dripline::storage
]])
endfunction()
