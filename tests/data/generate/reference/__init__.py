"""The three models, written from the papers' equations with NumPy and SciPy, without flap."""
