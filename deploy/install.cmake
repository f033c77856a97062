# cmake --install build/release --prefix /usr/local
include(GNUInstallDirs)
install(TARGETS dncd dncgw dnc null_modem RUNTIME)
install(FILES README.md CHANGELOG.md TYPE DOC)
install(DIRECTORY deploy/docs deploy/examples deploy/monitoring TYPE DOC USE_SOURCE_PERMISSIONS)
install(FILES server/api/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs RENAME rest-api.md)
install(FILES server/api/openapi.json DESTINATION ${CMAKE_INSTALL_DATADIR}/dripline)
install(DIRECTORY deploy/macros deploy/templates DESTINATION ${CMAKE_INSTALL_DATADIR}/dripline)
