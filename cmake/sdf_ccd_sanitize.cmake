# What scripts/trust builds: everything with sanitizers, and the fuzz targets. Not for use: it is several times slower.
set(SDF_CCD_SANITIZE "" CACHE STRING "Sanitizers for all that is built: \"address,undefined\" or \"thread\"")
option(SDF_CCD_FUZZ "Build the fuzz targets: with libFuzzer by clang, else to replay files" OFF)

if(SDF_CCD_SANITIZE)
  set(flags -fsanitize=${SDF_CCD_SANITIZE} -fno-omit-frame-pointer)
  if(SDF_CCD_SANITIZE MATCHES "undefined")
    # vptr needs the type information of libraries that are not built here.
    list(APPEND flags -fsanitize=float-cast-overflow -fno-sanitize=vptr)
  endif()
  list(APPEND flags -fno-sanitize-recover=all)
  add_compile_definitions(HWY_COMPILE_ONLY_STATIC)  # vector code for one instruction set: each takes minutes
  add_compile_options(${flags} -O1 -g1)  # after the build type's own -O3
  add_link_options(${flags})
  if(SDF_CCD_SANITIZE MATCHES "thread")
    # Else inline functions, of shared pointers among them, are taken from libraries that TSan has not seen.
    add_link_options(-Wl,-Bsymbolic-functions)
  endif()
  if(SDF_CCD_FUZZ AND CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    add_compile_options(-fsanitize=fuzzer-no-link)
  endif()
endif()
