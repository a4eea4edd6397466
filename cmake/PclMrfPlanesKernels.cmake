# What the bits of the kernels hang on, wherever the core is built.
function(pcl_mrf_planes_kernel_flags target)
  # Fused products and sums would make the bits depend on the instruction set.
  target_compile_options(${target} PRIVATE -ffp-contract=off)
  # On Arm the kernels are for NEON: a vector of SVE has no size at build time, and so cannot
  # be part of a struct.
  target_compile_definitions(${target} PRIVATE
    "HWY_DISABLED_TARGETS=(HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")
endfunction()
