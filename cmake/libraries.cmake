# Libraries beside deal.II. gmsh, CHOLMOD, HDF5, MPI and Trilinos come with
# deal.II: it hands over their include folders and links them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nanoflann 1.4 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(GTest REQUIRED)

find_library(PERIMORPH_MUMPS_LIBRARY dmumps REQUIRED)
find_path(PERIMORPH_GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_program(PERIMORPH_MPIRUN mpirun REQUIRED)
mark_as_advanced(
  PERIMORPH_GMSH_INCLUDE_DIR PERIMORPH_MPIRUN PERIMORPH_MUMPS_LIBRARY)
