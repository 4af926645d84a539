# SPDX-License-Identifier: GPL-3.0-or-later
# Third parties, all from Debian. The mechanics needs only Eigen, SuiteSparse (CHOLMOD, METIS), BLAS,
# HDF5 and CLI11; the image and surface stages are left out when their libraries are missing.
find_package(OpenMP REQUIRED COMPONENTS CXX)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
if(BREAST_TESTS)
  find_package(GTest REQUIRED)
  include(GoogleTest)
endif()

find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig REQUIRED)
add_library(breast_cholmod INTERFACE)
target_include_directories(breast_cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE})
target_link_libraries(breast_cholmod INTERFACE ${CHOLMOD_LIBRARY} ${SUITESPARSECONFIG_LIBRARY})

# The reference BLAS makes every factorisation 5-8 times slower; OpenBLAS is asked for by name.
find_library(OPENBLAS_LIBRARY openblas)
find_library(BLAS_LIBRARY blas REQUIRED)
add_library(breast_blas INTERFACE)
if(OPENBLAS_LIBRARY)
  target_link_libraries(breast_blas INTERFACE ${OPENBLAS_LIBRARY})
else()
  message(WARNING "OpenBLAS not found (libopenblas-dev): factorisations will be 5-8 times slower")
  target_link_libraries(breast_blas INTERFACE ${BLAS_LIBRARY})
endif()

find_package(VTK 9.1 QUIET COMPONENTS CommonCore CommonDataModel IOXML IOImage IOHDF)
find_package(ITK 5.2 QUIET COMPONENTS ITKCommon ITKIOImageBase ITKIONRRD ITKIOMeta ITKIOGDCM
  ITKImageGrid ITKSmoothing ITKThresholding ITKRegionGrowing ITKBinaryMathematicalMorphology
  ITKMathematicalMorphology ITKConnectedComponents ITKLabelMap ITKDistanceMap ITKImageFeature ITKImageFilterBase
  ITKImageStatistics ITKBiasCorrection ITKLabelVoting)
find_package(OpenCV QUIET COMPONENTS core imgproc imgcodecs)
find_package(CGAL QUIET)
find_package(GDCM QUIET)
find_library(XRL_LIBRARY xrl)
find_path(XRL_INCLUDE xraylib.h PATH_SUFFIXES xraylib)

find_path(NLOPT_INCLUDE nlopt.hpp)
find_library(NLOPT_LIBRARY NAMES nlopt_cxx nlopt)
if(NLOPT_INCLUDE AND NLOPT_LIBRARY)
  add_library(breast_nlopt INTERFACE)
  target_include_directories(breast_nlopt SYSTEM INTERFACE ${NLOPT_INCLUDE})
  target_link_libraries(breast_nlopt INTERFACE ${NLOPT_LIBRARY})
endif()

# Meshes for more than one process (libbreast/distributed). Debian's PETSc is linked with HDF5's MPI build, we
# with its serial one: their symbols have different versions (HDF5_MPI_..., HDF5_SERIAL_...), so that each
# library of one process calls its own (docs/scale.md). The package does without: few who install it have a cluster.
option(BREAST_MPI "forward-mpi and backward-mpi, where PETSc is installed" ON)
find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
  pkg_check_modules(PETSC QUIET petsc>=3.18)
endif()
find_package(MPI QUIET COMPONENTS C)
find_program(MPIRUN_PROGRAM mpirun)
if(BREAST_MPI AND PETSC_FOUND AND MPI_C_FOUND AND MPIRUN_PROGRAM)
  add_library(breast_petsc INTERFACE)
  target_include_directories(breast_petsc SYSTEM INTERFACE ${PETSC_INCLUDE_DIRS} ${MPI_C_INCLUDE_DIRS})
  target_compile_definitions(breast_petsc INTERFACE OMPI_SKIP_MPICXX MPICH_SKIP_MPICXX)
  target_link_libraries(breast_petsc INTERFACE ${PETSC_LINK_LIBRARIES} ${MPI_C_LIBRARIES})
endif()
