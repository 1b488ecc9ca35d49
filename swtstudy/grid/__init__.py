"""The grid of a study: named dimensions, their values, and the distinct points behind them."""
