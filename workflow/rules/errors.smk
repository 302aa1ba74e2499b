# What the forecasts are worth, as tables.


rule tabulate_forecast_errors:
    input:
        truth=expand("results/dataset/{split}.parquet", split=TEST_SETS),
        shapes=expand("results/terminal_shapes/{split}.parquet", split=TEST_SETS),
        forecasts=rules.forecasts.input,
    output:
        forecast_errors="results/tables/forecast_errors.csv",
        source_errors="results/tables/forecast_errors_source_recipe.csv",
        lookup_errors="results/tables/forecast_errors_lookup.csv",
        ensemble_errors="results/tables/ensemble_errors.csv",
        baselines="results/tables/baselines.csv",
    log:
        "results/logs/tabulate_forecast_errors.log",
    benchmark:
        "results/benchmarks/tabulate_forecast_errors.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=6000,
        runtime=10,
    params:
        code=code_of("tabulate_forecast_errors"),
        forecasters=" ".join(forecaster_words(name) for name in FORECASTERS),
    message:
        "tabulate the errors of all forecasts"
    shell:
        "sedfiber tabulate_forecast_errors --truth {input.truth} --shapes {input.shapes}"
        " {params.forecasters} --forecast-errors {output.forecast_errors}"
        " --source-errors {output.source_errors} --lookup-errors {output.lookup_errors}"
        " --ensemble-errors {output.ensemble_errors} --baselines {output.baselines} > {log} 2>&1"


rule tabulate_lags:
    input:
        truth=expand("results/dataset/{split}.parquet", split=TEST_SETS),
        shapes=expand("results/terminal_shapes/{split}.parquet", split=TEST_SETS),
        forecasts=rules.forecasts.input,
    output:
        "results/tables/lags.csv",
    log:
        "results/logs/tabulate_lags.log",
    benchmark:
        "results/benchmarks/tabulate_lags.tsv"
    conda:
        "../../envs/learning.yaml"
    threads: 1
    resources:
        mem_mb=6000,
        runtime=10,
    params:
        code=code_of("tabulate_lags"),
        forecasters=" ".join(forecaster_words(name) for name in FORECASTERS),
    message:
        "tabulate the lag of all forecasts"
    shell:
        "sedfiber tabulate_lags --truth {input.truth} --shapes {input.shapes}"
        " {params.forecasters} -o {output} > {log} 2>&1"


rule errors:
    input:
        rules.tabulate_forecast_errors.output,
        rules.tabulate_lags.output,
