# The figures of the forecasts.


use rule plot_problem as plot_forecast_shapes_A with:
    input:
        truth="results/dataset/A.parquet",
        forecasts=forecasts_of("A"),
        table=ERRORS_TABLE,
    output:
        **drawn("forecast_shapes_A"),
    log:
        "results/logs/plot_forecast_shapes_A.log",
    benchmark:
        "results/benchmarks/plot_forecast_shapes_A.tsv"
    params:
        code=code_of("plot_forecast_shapes"),
        call=drawn_from("plot_forecast_shapes", "--test-set A", *PAIRED),
    message:
        "draw best and worst forecast shapes of test set A"


use rule plot_problem as plot_forecast_shapes_B with:
    input:
        truth="results/dataset/B.parquet",
        forecasts=forecasts_of("B"),
        table=ERRORS_TABLE,
    output:
        **drawn("forecast_shapes_B"),
    log:
        "results/logs/plot_forecast_shapes_B.log",
    benchmark:
        "results/benchmarks/plot_forecast_shapes_B.tsv"
    params:
        code=code_of("plot_forecast_shapes"),
        call=drawn_from("plot_forecast_shapes", "--test-set B", *PAIRED),
    message:
        "draw best and worst forecast shapes of test set B"


use rule plot_problem as plot_forecast_paths with:
    input:
        truth=expand("results/dataset/{split}.parquet", split=TEST_SETS),
        forecasts=[forecasts_of(split) for split in TEST_SETS],
        table=ERRORS_TABLE,
    output:
        **drawn("forecast_paths"),
    log:
        "results/logs/plot_forecast_paths.log",
    benchmark:
        "results/benchmarks/plot_forecast_paths.tsv"
    params:
        code=code_of("plot_forecast_paths"),
        call=drawn_from("plot_forecast_paths", *PAIRED),
    message:
        "draw best and worst forecast paths of the centre bead"


use rule plot_problem as plot_forecast_errors with:
    input:
        table="results/tables/ensemble_errors.csv",
    output:
        **drawn("forecast_errors"),
    log:
        "results/logs/plot_forecast_errors.log",
    benchmark:
        "results/benchmarks/plot_forecast_errors.tsv"
    params:
        code=code_of("plot_forecast_errors"),
        call=drawn_from("plot_forecast_errors", "{table}", f"--model {FORECAST_MODEL}"),
    message:
        "draw the ensemble mean of E(t)"


use rule plot_problem as plot_contact_sheet with:
    input:
        truth=expand("results/dataset/{split}.parquet", split=TEST_SETS),
        forecasts=[forecasts_of(split) for split in TEST_SETS],
        table=ERRORS_TABLE,
    output:
        **drawn("contact_sheet"),
    log:
        "results/logs/plot_contact_sheet.log",
    benchmark:
        "results/benchmarks/plot_contact_sheet.tsv"
    params:
        code=code_of("plot_contact_sheet"),
        call=drawn_from("plot_contact_sheet", *PAIRED),
    message:
        "draw every test trajectory, true and forecast"


use rule plot_problem as plot_error_distribution with:
    input:
        table="results/tables/forecast_errors.csv",
    output:
        **drawn("error_distribution"),
    log:
        "results/logs/plot_error_distribution.log",
    benchmark:
        "results/benchmarks/plot_error_distribution.tsv"
    params:
        code=code_of("plot_error_distribution"),
        call=drawn_from("plot_error_distribution", "{table}"),
    message:
        "draw the largest error of every trajectory"


use rule plot_problem as plot_baselines with:
    input:
        table="results/tables/baselines.csv",
    output:
        **drawn("baselines"),
    log:
        "results/logs/plot_baselines.log",
    benchmark:
        "results/benchmarks/plot_baselines.tsv"
    params:
        code=code_of("plot_baselines"),
        call=drawn_from("plot_baselines", "{table}"),
    message:
        "draw worst and median error beside the baseline"


use rule plot_problem as plot_lags with:
    input:
        table="results/tables/lags.csv",
    output:
        **drawn("lags"),
    log:
        "results/logs/plot_lags.log",
    benchmark:
        "results/benchmarks/plot_lags.tsv"
    params:
        code=code_of("plot_lags"),
        call=drawn_from("plot_lags", "{table}", f"--model {FORECAST_MODEL}"),
    message:
        "draw the lag of every forecast"


rule figures:
    input:
        expand("results/figures/{figure}.{kind}", figure=STUDY_FIGURES, kind=["svg", "png"]),
