"""Archives: netCDF files that hold a study's results and all that is needed to understand them."""
