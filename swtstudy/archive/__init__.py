"""Running studies, and archives: netCDF files with results and all that is needed to understand them."""
