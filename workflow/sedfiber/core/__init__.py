"""What every room uses: errors, checks of single values, files that appear whole, compiled kernels."""
