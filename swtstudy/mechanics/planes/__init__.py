"""From stress histories to swt over planes: it knows no contact."""
