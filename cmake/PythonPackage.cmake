# Where the Python package goes, and whether its compiled part is built: SKEIN_PYTHON_MODULE becomes OFF where it cannot be.

# The folder of packages below a prefix, for the Python that the program was built for: Debian has names of its own.
function(skein_find_python_folder)
  set(script "
import sys, sysconfig
version = 'python%d.%d' % sys.version_info[:2]
if 'deb_system' not in sysconfig.get_scheme_names():
    print('lib/' + version + '/site-packages')
elif '${CMAKE_INSTALL_PREFIX}' == '/usr':
    print('lib/python3/dist-packages')
else:
    print('lib/' + version + '/dist-packages')
")
  execute_process(COMMAND ${SKEIN_PYTHON} -I -c "${script}" OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(SKEIN_PYTHON_FOLDER ${folder} CACHE STRING "Where the Python package goes, below the prefix")
endfunction()

function(skein_find_pybind11)
  if(CMAKE_CXX_COMPILER MATCHES "nvcc_wrapper" OR SKEIN_SANITIZE)
    set(SKEIN_PYTHON_MODULE OFF PARENT_SCOPE)
    message(STATUS "Python: the package reads runs; its compiled part is built neither by nvcc nor with sanitizers, which "
                   "an interpreter built without them cannot load")
    return()
  endif()
  if(NOT SKBUILD)  # which says for which Python a wheel is
    set(Python_EXECUTABLE ${SKEIN_PYTHON})
  endif()
  find_package(Python COMPONENTS Interpreter Development.Module QUIET)
  find_package(pybind11 CONFIG QUIET)
  if(pybind11_FOUND AND Python_Development.Module_FOUND)
    message(STATUS "Python: pybind11 ${pybind11_VERSION}, the package for Python ${Python_VERSION}")
  else()
    set(SKEIN_PYTHON_MODULE OFF PARENT_SCOPE)
    message(STATUS "Python: the package reads runs; its compiled part needs Debian's pybind11-dev and python3-dev")
  endif()
endfunction()

skein_find_python_folder()
if(SKEIN_PYTHON_MODULE)
  skein_find_pybind11()
endif()
