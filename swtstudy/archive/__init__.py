"""Archives: netCDF files with a study's results and everything needed to understand them."""
