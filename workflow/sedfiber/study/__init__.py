"""The study that config.yaml describes: data sets, errors, tables, costs and hard cases."""
