# What the library needs, in the build and again wherever its installation is found (wishboneConfig.cmake).
# Everything comes from the distribution's packages (scripts/install-packages lists them).
find_package(Eigen3 3.4 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(SUNDIALS 6.4 REQUIRED COMPONENTS cvode ida arkode)
# The sparse direct solver by its own name: the target that SUNDIALS exports for it refers to one that nobody defines.
find_path(KLU_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(KLU_LIBRARY klu REQUIRED)
find_library(SUNLINSOLKLU_LIBRARY sundials_sunlinsolklu REQUIRED)
find_library(SUNMATRIXSPARSE_LIBRARY sundials_sunmatrixsparse REQUIRED)
add_library(WishboneDeps::sundials_klu INTERFACE IMPORTED)
target_include_directories(WishboneDeps::sundials_klu INTERFACE ${KLU_INCLUDE_DIR})
target_link_libraries(WishboneDeps::sundials_klu INTERFACE ${SUNLINSOLKLU_LIBRARY} ${SUNMATRIXSPARSE_LIBRARY} ${KLU_LIBRARY})

# The serial HDF5 by its own pkg-config name: the plain name turns into the MPI flavour as soon as PETSc
# (which SUNDIALS pulls in) has been installed.
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5_SERIAL REQUIRED IMPORTED_TARGET hdf5-serial)
add_library(WishboneDeps::hdf5 INTERFACE IMPORTED)
target_link_libraries(WishboneDeps::hdf5 INTERFACE PkgConfig::HDF5_SERIAL hdf5_serial_hl)

find_path(UDUNITS2_INCLUDE_DIR udunits2.h REQUIRED)
find_library(UDUNITS2_LIBRARY udunits2 REQUIRED)
add_library(WishboneDeps::udunits2 INTERFACE IMPORTED)
target_include_directories(WishboneDeps::udunits2 INTERFACE ${UDUNITS2_INCLUDE_DIR})
target_link_libraries(WishboneDeps::udunits2 INTERFACE ${UDUNITS2_LIBRARY})
