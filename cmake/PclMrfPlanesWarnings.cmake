# Warnings as errors for one of our own targets; nothing global, nothing exported.
function(pcl_mrf_planes_warnings target)
  target_compile_options(${target} PRIVATE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  if(PCL_MRF_PLANES_WERROR)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
endfunction()
